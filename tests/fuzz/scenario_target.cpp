// Scenarios, and studies of them, as TOML: read or refused.
//
// Lines `#set PATH=VALUE` are overrides, as on the command line. A text that has [[output]] is a
// study; its cases are overrides of a scenario that is always there.
#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/toml_mutator.hpp"
#include "tools/fit/parameter_text.hpp"
#include "tools/study/study_cases.hpp"

using namespace articular;

namespace {

constexpr const char* kStudied = R"(
title = "A falling block"
duration = "1 s"
[choice]
block = "tissue"
[integrator]
step = "1 ms"
[[body]]
name = "block"
kind = "tissue"
geometry = { box = { size = "1 1 1 mm", cells = [1, 1, 1] } }
density = "1 g/cm^3"
material = { law = "neo-hookean", young_modulus = "1 kPa", poisson_ratio = 0.4 }
when = { block = "tissue" }
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
)";
constexpr const char* kMotion = "time [s],translation.z [mm]\n0,0\n0.5,1\n1,0\n";
constexpr const char* kMuscles =
    "id,muscle,body_upper,ux_mm,uy_mm,uz_mm,body_lower,lx_mm,ly_mm,lz_mm,max_force_N,"
    "max_over_opt_length,tendon_ratio\n"
    "a,\"anterior, deep\",low,58,-8,144,high,37,7,57,158,1.2,0.5\n";

std::vector<std::string> overrides_in(std::string_view text) {
  constexpr std::string_view kMark = "#set ";
  std::vector<std::string> overrides;
  for (std::size_t at = 0; (at = text.find(kMark, at)) != std::string_view::npos;) {
    at += kMark.size();
    const std::size_t end = std::min(text.find('\n', at), text.size());
    overrides.emplace_back(text.substr(at, end - at));
    at = end;
  }
  return overrides;
}

void read_study_and_its_cases(std::string_view text) {
  fuzz::read_or_refused([&] {
    const tools::Study study = tools::read_study(fuzz::as_file("study.toml", text));
    const std::vector<tools::StudyCase> cases = tools::study_cases(study);
    static const std::filesystem::path scenario = fuzz::as_file("studied.toml", kStudied);
    for (std::size_t i = 0; i < std::min<std::size_t>(cases.size(), 3); ++i)
      fuzz::read_or_refused([&] { sim::read_scenario(scenario, cases[i].settings.overrides); });
  });
}

void read_fit_and_its_start(std::string_view text) {
  fuzz::read_or_refused([&] {
    const tools::Fit fit = tools::read_fit(fuzz::as_file("fit.toml", text));
    Eigen::VectorXd start(static_cast<Eigen::Index>(fit.parameters.size()));
    for (Eigen::Index i = 0; i < start.size(); ++i)
      start[i] = fit.parameters[static_cast<std::size_t>(i)].start;
    static const std::filesystem::path scenario = fuzz::as_file("studied.toml", kStudied);
    sim::read_scenario(scenario, tools::overrides_of(fit, fit.runs.front(), start));
  });
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  fuzz::as_file("motion.csv", kMotion);
  fuzz::as_file("muscles.csv", kMuscles);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::as_text(data, size);
  if (text.find("[[measurement]]") != std::string_view::npos)
    read_fit_and_its_start(text);
  else if (text.find("[[output]]") != std::string_view::npos)
    read_study_and_its_cases(text);
  else
    fuzz::read_or_refused(
        [&] { sim::read_scenario(fuzz::as_file("scenario.toml", text), overrides_in(text)); });
  return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

std::size_t put(const std::string& text, std::uint8_t* data, std::size_t most) {
  const std::size_t size = std::min(text.size(), most);
  std::copy_n(text.begin(), size, data);
  return size;
}

}  // namespace

/// Bytes are changed too: half of the time, and where structure made no change.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  std::mt19937 random(seed);
  const std::string text(fuzz::as_text(data, size));
  if (random() % 2 == 0) {
    const std::string changed = fuzz::changed_toml(text, "", random);
    if (!changed.empty() && changed != text) return put(changed, data, most);
  }
  return LLVMFuzzerMutate(data, size, most);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data, std::size_t size,
                                                 const std::uint8_t* other, std::size_t other_size,
                                                 std::uint8_t* out, std::size_t most,
                                                 unsigned seed) {
  std::mt19937 random(seed);
  return put(fuzz::changed_toml(std::string(fuzz::as_text(data, size)),
                                fuzz::as_text(other, other_size), random),
             out, most);
}
