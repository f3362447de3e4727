// `articular run --error-bars` as a user runs it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/tools/support/program.hpp"

namespace articular::error_bars_run_test {

// A cantilever under its own weight, in equilibrium. Timoshenko: the end goes down by
//   rho g L^4 3 / (2 E d^2) + rho g L^2 6 / (5 E) = 0.0987 mm
// for L = 20 mm, d = 5 mm, E = 1 MPa.
const std::string kBeam = R"(
analysis = 'static'
duration = '1 s'
contact = false
[integrator]
step = '0.25 s'
[[body]]
name = 'wall'
kind = 'fixed'
[[body]]
name = 'beam'
kind = 'tissue'
geometry = { box = { size = '20 5 5 mm', cells = [16, 4, 4], center = '10 0 0 mm' } }
density = '1000 kg/m^3'
material = { law = 'linear', young_modulus = '1 MPa', poisson_ratio = 0, element = 'plain' }
[[attach]]
body = 'beam'
to = 'wall'
region = { box = ['-0.1 -3 -3 mm', '0.1 3 3 mm'] }
[[load]]
kind = 'gravity'
acceleration = '0 0 -9.81 m/s^2'
[[probe]]
name = 'end'
kind = 'point'
body = 'beam'
point = '20 0 0 mm'
[output]
interval = '1 s'
)";
constexpr double kTimoshenko = -9.81e3 * (1.5 * 1.6e-7 / 25e-6 + 1.2 * 4e-4) * 1e-3;  // [mm]

/// The numbers behind `key` in a line of a table.
std::vector<double> numbers_behind(const std::string& key, const std::string& table) {
  std::vector<double> numbers;
  const std::size_t at = table.find(key);
  if (at == std::string::npos) return numbers;
  std::istringstream cells(table.substr(at + key.size(), table.find('\n', at) - at - key.size()));
  for (std::string cell; std::getline(cells, cell, ',');)
    numbers.push_back(std::strtod(cell.c_str(), nullptr));
  return numbers;
}

TEST(RunErrorBars, CoverTheErrorAndLeaveTheResultsAsTheyAre) {
  const TemporaryFolder folder;
  folder.file("beam.toml", kBeam);
  ASSERT_EQ(run_program(folder, "run beam.toml --out plain --quiet").exit_code, 0);
  const ProgramResult result =
      run_program(folder, "run beam.toml --out bars --error-bars --threads 2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(content(folder / "bars/history.csv"), content(folder / "plain/history.csv"));
  EXPECT_NE(result.err.find("error bars: 3 coarser runs"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("[3/3] "), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("bars/error_bars.csv\n"), std::string::npos) << result.out;

  const std::string table = content(folder / "bars/error_bars.csv");
  const std::vector<double> row = numbers_behind("end.position.z [mm],end,", table);
  ASSERT_GT(row.size(), 2U) << table;
  const double error = std::abs(row[0] - kTimoshenko), bar = row[1];
  EXPECT_GT(bar, error);
  EXPECT_LT(bar, 5 * error);
  const auto summary = nlohmann::json::parse(content(folder / "bars/summary.json"));
  EXPECT_EQ(summary.at("outcome"), "finished");
  EXPECT_EQ(summary.at("error_bars").at("mesh").at("sizes").size(), 3U);
  EXPECT_EQ(summary.at("error_bars").at("contact").at("remark"), "nothing touches");

  // What is there is kept with --resume; results of a run without bars have none.
  const ProgramResult again =
      run_program(folder, "run beam.toml --out bars --error-bars --threads 2 --resume");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(again.err.find("[1/"), std::string::npos) << again.err;
  EXPECT_EQ(content(folder / "bars/error_bars.csv"), table);
  ASSERT_EQ(run_program(folder, "run beam.toml --out bars --quiet").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "bars/error_bars.csv"));
}

// One cell less and no node of the beam lies in the attached region: the coarser runs fail, the run
// does not.
TEST(RunErrorBars, OfFailedCoarserRunsAreNotEstimatedAndTheRunIsWhole) {
  const TemporaryFolder folder;
  std::string scene = kBeam;
  scene.replace(scene.find("'-0.1 -3 -3 mm', '0.1 3 3 mm'"), 29, "'1.2 -3 -3 mm', '1.3 3 3 mm'");
  folder.file("beam.toml", scene);
  const ProgramResult result = run_program(
      folder, "run beam.toml --out bars --error-bars --set integrator.step='1 s' --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string table = content(folder / "bars/error_bars.csv");
  EXPECT_NE(table.find("not estimated (mesh: the coarser run `mesh 1.33 times` failed; "),
            std::string::npos)
      << table;
  EXPECT_NE(result.out.find("`mesh 1.33 times` failed: bad input: "), std::string::npos)
      << result.out;
  EXPECT_NE(content(folder / "bars/summary.json").find("\"finished\""), std::string::npos);
}

TEST(RunErrorBars, InterruptedInACoarserRunLeaveTheResultsWhole) {
  const TemporaryFolder folder;
  folder.file("beam.toml", kBeam);
  const ProgramResult stopped = run_shell(
      folder,
      "\"$articular\" run beam.toml --out bars --error-bars --set analysis=dynamic --set "
      "duration='0.2 s' --set integrator.step='1 ms' & pid=$!; "
      "while [ -z \"$(ls bars/error-bars/cases 2> /dev/null)\" ] && kill -0 $pid; do sleep 0.02; "
      "done; kill -TERM $pid; wait $pid");
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_NE(stopped.err.find("--resume goes on with what is missing"), std::string::npos)
      << stopped.err;
  EXPECT_NE(content(folder / "bars/summary.json").find("\"finished\""), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "bars/error_bars.csv"));
}

}  // namespace articular::error_bars_run_test
