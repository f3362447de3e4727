// `articular run --target-error` as a user runs it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/tools/support/program.hpp"

namespace articular::target_error_run_test {

const std::string kStatics =
    " --set analysis=static --set integrator.step='0.5 s' --set output.interval='0.5 s' --set "
    "duration='1 s'";

/// A scene whose answer is known.
struct Known {
  std::string name, scene, target, of;
  double answer = 0, uncertainty = 0;
};

// A rod on a hinge, whose rest lies 1 degree aside: 1 - cos(wt) degrees with w^2 = m g (L/2) / I
// and I = m (L^2/3 + d^2/12), L = 100 mm, d = 10 mm.
const std::string kPendulum = R"(
duration = "0.4 s"
contact = false
[integrator]
step = "4 ms"
[output]
interval = "40 ms"
[[body]]
name = "bar"
kind = "rigid"
geometry = { box = { size = "10 10 100 mm", cells = [1, 1, 1], center = "0 0 -50 mm" } }
density = "1000 kg/m^3"
hold = { freedoms = ["translation.x", "translation.y", "translation.z", "rotation.y", "rotation.z"], at = "0 0 0 mm" }
[[load]]
kind = "gravity"
acceleration = "0 0.17120818 -9.80850589 m/s^2"
[[probe]]
name = "bar"
kind = "angle"
body = "bar"
)";
const double kPendulumAnswer = 1 - std::cos(0.4 * std::sqrt(9.81 * 0.05 / (0.01 / 3 + 1e-4 / 12)));

// Tissue falls, braked: z = -g/a (t - (1 - exp(-at))/a).
const std::string kDrop = R"(
duration = "0.2 s"
contact = false
[integrator]
step = "2 ms"
[[body]]
name = "cube"
kind = "tissue"
geometry = { box = { size = "10 10 10 mm", cells = [3, 3, 3] } }
density = "1000 kg/m^3"
material = { law = "linear", young_modulus = "100 kPa", poisson_ratio = 0, element = "plain", mass_damping = "5 1/s" }
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[probe]]
name = "middle"
kind = "point"
body = "cube"
point = "0 0 0 mm"
)";
const double kDropAnswer = -9810 / 5.0 * (0.2 - (1 - std::exp(-1.0)) / 5);

class TargetErrorOf : public testing::TestWithParam<Known> {};

// Timoshenko's beam, a hanging bar, a ball on a layer (three finer meshes; Dimitriadis' series has
// -0.0944), a pendulum and a cube that drops.
TEST_P(TargetErrorOf, KnownAnswersIsMetAndTheEstimateCoversTheTrueError) {
  const Known& known = GetParam();
  const TemporaryFolder folder;
  folder.file("pendulum.toml", kPendulum);
  folder.file("drop.toml", kDrop);
  const ProgramResult result =
      run_program(folder, "run " + known.scene + " --target-error " + known.target + " --of " +
                              known.of + " --out out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto told = nlohmann::json::parse(content(folder / "out/summary.json")).at("target_error");
  const double value = told.at("value"), estimate = told.at("estimated_error");
  EXPECT_LT(std::abs(value - known.answer), estimate + known.uncertainty) << result.out;
  EXPECT_TRUE(told.at("met").get<bool>());
  const double share = std::strtod(known.target.c_str(), nullptr) / 100;
  EXPECT_LE(estimate, share * told.at("relative_to").get<double>());
  EXPECT_NE(result.out.find(known.target + " is met"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("chosen, for "), std::string::npos) << result.err;
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, TargetErrorOf,
    testing::Values(
        Known{
            "Beam",
            "verification/bending_beam --set body.beam.geometry.box.cells='[24, 2, 4]'" + kStatics,
            "8%", "end.position.z", -1.9495},
        Known{"Bar", "verification/hanging_beam" + kStatics, "1%", "end.position.z", -102.4525},
        Known{"Hertz",
              "verification/tool_on_tissue --set analysis=static --set duration='0.2 s' --set "
              "integrator.step='0.1 s' --set "
              "output.interval='0.1 s'",
              "20%", "tool.force", 0.0956, 0.0004},
        Known{"Pendulum", "pendulum.toml", "2%", "bar", kPendulumAnswer},
        Known{"Drop", "drop.toml", "1%", "middle.position.z", kDropAnswer}),
    [](const auto& info) { return info.param.name; });

TEST(RunTargetError, KeepsWhatItFoundAndDoesNotRunItAgain) {
  const TemporaryFolder folder;
  folder.file("drop.toml", kDrop);
  const std::string command = "run drop.toml --target-error 2% --of middle.position.z --out out";
  const ProgramResult first = run_program(folder, command);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(first.err.find("] coarse: done"), std::string::npos) << first.err;
  const ProgramResult second = run_program(folder, command);
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.err.find("] coarse: done"), std::string::npos) << second.err;
  EXPECT_EQ(second.out, first.out.substr(first.out.find("\n`") + 0)) << second.out;
  // The settings that it names give the same result.
  std::string settings;
  const std::size_t at = first.out.find("  --set ");
  ASSERT_NE(at, std::string::npos) << first.out;
  std::istringstream lines(first.out.substr(at));
  for (std::string line; std::getline(lines, line);)
    settings += " --set '" + line.substr(std::string("  --set ").size()) + "'";
  ASSERT_EQ(run_program(folder, "run drop.toml --out again" + settings).exit_code, 0);
  EXPECT_EQ(content(folder / "again/history.csv"), content(folder / "out/history.csv"));
}

// A loose target: the coarse run is good enough, and a third, coarser one shows so.
TEST(RunTargetError, WhereTheCoarseRunIsGoodEnoughACoarserOneConfirmsTheOrder) {
  const TemporaryFolder folder;
  folder.file("drop.toml", kDrop);
  const ProgramResult result =
      run_program(folder, "run drop.toml --target-error 5% --of middle.position.z --out out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("coarser runs confirm the order"), std::string::npos) << result.err;
  const auto told = nlohmann::json::parse(content(folder / "out/summary.json")).at("target_error");
  EXPECT_EQ(told.at("parts").at("step").at("sizes").size(), 3U);
  const double error = std::abs(told.at("value").get<double>() - kDropAnswer);
  EXPECT_LT(error, told.at("estimated_error").get<double>());
  EXPECT_GT(5 * error, told.at("estimated_error").get<double>());
}

TEST(RunTargetError, RefusesWhatIsNoResult) {
  const TemporaryFolder folder;
  folder.file("drop.toml", kDrop);
  const auto asked = [&](const std::string& options) {
    return run_program(folder, "run drop.toml --out out --quiet " + options);
  };
  const ProgramResult unknown = asked("--target-error 2% --of centre");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_EQ(unknown.err.rfind("articular: --of \"centre\": there is no such probe", 0), 0U)
      << unknown.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/target-error"));
  const ProgramResult nil = asked("--target-error 2% --of middle.position.x");
  EXPECT_EQ(nil.exit_code, 2);
  EXPECT_NE(nil.err.find("does not move: 2% of nothing"), std::string::npos) << nil.err;
  EXPECT_EQ(asked("--target-error 2%").exit_code, 2);
  EXPECT_EQ(asked("--of middle").exit_code, 2);
  EXPECT_EQ(asked("--target-error 2% --of middle.position.z --budget 10").exit_code, 2);
  EXPECT_EQ(asked("--target-error 2% --of middle.position.z --error-bars").exit_code, 2);
}

TEST(RunTargetError, ThatTheBudgetDoesNotAllowIsRefusedWithWhatItAllows) {
  const TemporaryFolder folder;
  folder.file("drop.toml", kDrop);
  const std::string command = "run drop.toml --of middle.position.z --out out --quiet ";
  const ProgramResult refused = run_program(folder, command + "--target-error 1e-7%");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("can't be had"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find(" can be had in "), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/history.csv"));
  const ProgramResult none = run_program(folder, command + "--target-error 1% --budget '1 us'");
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.err.find("--budget"), std::string::npos) << none.err;
}

/// The coarse runs are said to have taken next to no time.
void belittle_coarse_runs(const std::filesystem::path& results) {
  int changed = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(results / "target-error"))
    if (entry.path().filename() == "case.json") {
      auto record = nlohmann::json::parse(content(entry.path()));
      for (auto& run : record.at("runs")) run.at("wall_s") = 1e-3;
      std::ofstream(entry.path()) << record;
      ++changed;
    }
  ASSERT_GT(changed, 0);
}

// Foretold to take milliseconds, it takes half a second.
TEST(RunTargetError, ARunThatTakesLongerThanForetoldIsStoppedAtTheEndOfTheBudget) {
  const TemporaryFolder folder;
  folder.file("drop.toml", kDrop);
  const std::string command = "run drop.toml --of middle.position.z --out out --quiet ";
  ASSERT_EQ(run_program(folder, command + "--target-error 1e-7%").exit_code, 3);
  belittle_coarse_runs(folder / "out");
  const ProgramResult stopped =
      run_program(folder, command + "--target-error 0.03% --budget '0.1 s'");
  EXPECT_EQ(stopped.exit_code, 3);
  EXPECT_NE(stopped.err.find("--budget 0.1 s is over"), std::string::npos) << stopped.err;
  const auto summary = nlohmann::json::parse(content(folder / "out/summary.json"));
  EXPECT_EQ(summary.at("outcome"), "interrupted");
  EXPECT_LT(summary.at("simulated_time_s").get<double>(), 0.2);
  const ProgramResult whole = run_program(folder, command + "--target-error 0.03% --resume");
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
}

}  // namespace articular::target_error_run_test
