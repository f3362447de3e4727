// A run whose files can't be written, that is killed or loses its power at any of its calls. Every
// case begins with `area/out` as a Start says; then the run is disturbed, and `--resume` must lead
// to the files of an undisturbed run, bit for bit.
//
// ARTICULAR_FAULTS_EVERY=1 goes through all calls with all faults, as tests/faults/run does;
// without it a few dozen runs are tried, with the faults by turns.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <ostream>
#include <random>
#include <sstream>

#include "tests/faults/disturbed_run.hpp"
#include "tests/faults/power_cut.hpp"

namespace articular::faults {
namespace {

namespace fs = std::filesystem;

const std::string kScene = R"(
duration = "0.4 ms"
[output]
interval = "0.1 ms"
checkpoint_interval = "0.1 ms"
[integrator]
step = "0.05 ms"
[[body]]
name = "floor"
kind = "fixed"
geometry = { box = { size = "6 6 1 mm", cells = [1, 1, 1], center = "0 0 -2.5 mm" } }
[[body]]
name = "disc"
kind = "tissue"
density = "1 g/cm^3"
material = { law = "linear", young_modulus = "5 MPa", poisson_ratio = 0.3, element = "plain" }
geometry = { box = { size = "4 4 4 mm", cells = [2, 2, 2] } }
[[attach]]
body = "disc"
to = "floor"
region = { box = ["-6 -6 -3 mm", "6 6 -1.9 mm"] }
[[load]]
kind = "motion"
body = "floor"
time = ["0 ms", "1 ms"]
translation = ["0 0 0 mm", "0.1 0 0 mm"]
[[probe]]
name = "disc"
kind = "energy"
)";

std::string static_scene() {
  std::string scene = "analysis = \"static\"\n" + kScene;
  for (const std::string cut :
       {"checkpoint_interval = \"0.1 ms\"\n", "[integrator]\nstep = \"0.05 ms\"\n"})
    scene.erase(scene.find(cut), cut.size());
  return scene;
}

/// What stands in the folder, and how the run is started.
struct Start {
  const char* name;
  std::size_t number;
  bool is_static;
  bool has_results;  // of a run that finished
  bool resumes;

  std::string more() const { return resumes ? "--resume" : ""; }
};

void PrintTo(const Start& start, std::ostream* out) { *out << start.name; }

constexpr std::array kStarts = {
    Start{"New", 0, false, false, false},       Start{"Again", 1, false, true, false},
    Start{"Resumed", 2, false, true, true},     Start{"StaticNew", 3, true, false, false},
    Start{"StaticAgain", 4, true, true, false}, Start{"StaticResumed", 5, true, true, true},
};

/// 1 where all is to be tried, else of how many calls one is.
std::size_t every() {
  const char* given = std::getenv("ARTICULAR_FAULTS_EVERY");
  return given != nullptr ? std::max<std::size_t>(1, std::strtoul(given, nullptr, 10)) : 37;
}

class Faults : public ::testing::TestWithParam<Start> {
 protected:
  Faults() {
    folder_.file("scene.toml", GetParam().is_static ? static_scene() : kScene);
    fs::create_directory(folder_ / "before");
    fs::create_directory(area());
    calls_of_run(folder_);
    whole_ = results(out());
    if (GetParam().has_results)
      fs::copy(out(), folder_ / "before/out", fs::copy_options::recursive);
    set_up();
    calls_ = calls_of_run(folder_, GetParam().more());
    EXPECT_EQ(difference(whole_, results(out())), "");
    EXPECT_EQ(outcome(out()), "finished");
  }

  fs::path area() const { return folder_ / "area"; }
  fs::path out() const { return folder_ / "area/out"; }

  /// Where not all is tried, other calls from start to start, and the kinds by turns.
  static std::size_t first() { return 1 + 5 * GetParam().number % every(); }
  static bool is_due(std::size_t call, std::size_t kind, std::size_t num_kinds) {
    return every() == 1 || kind == (call / every() + GetParam().number) % num_kinds;
  }

  void set_up() const {
    fs::remove_all(area());
    fs::copy(folder_ / "before", area(), fs::copy_options::recursive);
  }

  /// After whatever came over a run.
  void expect_nothing_is_lost(const std::string& what) {
    ++num_tried_;
    if (outcome(out()) == "finished") {
      auto files = results(out());  // beside which a new summary may have been begun
      files.erase("summary.json.part");
      EXPECT_EQ(difference(whole_, files), "") << what << ", and it says finished";
    }
    const ProgramResult resumed = run_with_fault(folder_, {}, "--resume");
    EXPECT_EQ(resumed.exit_code, 0) << what << ", then --resume: " << resumed.err;
    EXPECT_EQ(difference(whole_, results(out())), "") << what << ", then --resume";
  }

  /// A call that looks for something that is not there; and whose results these are, which the
  /// summary tells, the series tells as well.
  static bool may_fail(const Call& call) {
    return call.kind == Call::Kind::Failed ||
           (call.kind == Call::Kind::Open && fs::path(call.path).filename() == "summary.json");
  }

  static std::string without_warnings(const std::string& words) {
    std::istringstream in(words);
    std::string kept;
    for (std::string line; std::getline(in, line);)
      if (line.rfind("articular: warning: ", 0) != 0) kept += line + '\n';
    return kept;
  }

  void expect_error(const ProgramResult& result, const std::string& what) const {
    const std::string words = without_warnings(result.err);
    EXPECT_EQ(result.exit_code, 4) << what << words;
    EXPECT_EQ(std::count(words.begin(), words.end(), '\n'), 1) << what << words;
    EXPECT_EQ(words.rfind("articular: ", 0), 0U) << what << words;
  }

  void disturb(const Fault& fault) {
    set_up();
    const ProgramResult result = run_with_fault(folder_, fault, GetParam().more());
    const auto kind = static_cast<char>(calls_[fault.at - 1].kind);
    const std::string what = fault.with + " at call " + std::to_string(fault.at) + " (" + kind +
                             " " + calls_[fault.at - 1].path + ") ";
    if (fault.with == "kill" || fault.with == "tear")
      EXPECT_EQ(result.exit_code, 137) << what;
    else if (fault.with == "short")
      EXPECT_EQ(result.exit_code, 0) << what << result.err;
    else if (result.exit_code != 0 || !may_fail(calls_[fault.at - 1]))
      expect_error(result, what);
    expect_nothing_is_lost(what);
  }

  ~Faults() override {
    std::cout << num_tried_ << " disturbed runs of " << calls_.size() << " calls\n";
  }

  const TemporaryFolder folder_;
  std::map<std::string, std::string> whole_;
  std::vector<Call> calls_;
  int num_tried_ = 0;
};

constexpr std::array kFaults = {"ENOSPC", "kill",    "EIO",    "tear",
                                "EROFS",  "ENOSPC+", "EDQUOT", "short"};

TEST_P(Faults, AtAnyCallEndInOrderAndAreResumed) {
  for (std::size_t at = first(); at <= calls_.size(); at += every())
    for (std::size_t f = 0; f < kFaults.size(); ++f)
      if (is_due(at, f, kFaults.size())) disturb({kFaults[f], at});
}

TEST_P(Faults, OneAfterAnotherLeadToTheSameResults) {
  std::mt19937 random(20261124);
  const std::size_t num_series = every() == 1 ? 20 : 1;
  for (std::size_t series = 0; series < num_series; ++series) {
    set_up();
    std::string more = GetParam().more();
    for (int run = 0; run < 6; ++run, more = "--resume") {
      const std::size_t at = std::uniform_int_distribution<std::size_t>(1, calls_.size())(random);
      const std::size_t f =
          std::uniform_int_distribution<std::size_t>(0, kFaults.size() - 1)(random);
      const int code = run_with_fault(folder_, {kFaults[f], at}, more).exit_code;
      EXPECT_TRUE(code == 0 || code == 4 || code == 137) << code << " with " << kFaults[f];
      ++num_tried_;
    }
    expect_nothing_is_lost("series " + std::to_string(series));
  }
}

TEST_P(Faults, APowerCutAtAnyCallIsSurvived) {
  std::mt19937 random(20261124);
  for (std::size_t done = first(); done <= calls_.size(); done += every())
    for (std::size_t c = 0; c < kPowerCuts.size(); ++c) {
      if (!is_due(done, c, kPowerCuts.size())) continue;
      fs::remove_all(area());
      cut_power(folder_ / "before", area(), {calls_.data(), done}, kPowerCuts[c], random, area());
      const std::string last = done > 0 ? calls_[done - 1].path : "";
      expect_nothing_is_lost("power cut after call " + std::to_string(done) + " " + last + ": " +
                             kPowerCuts[c].name);
    }
}

INSTANTIATE_TEST_SUITE_P(OfARun, Faults, ::testing::ValuesIn(kStarts),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace articular::faults
