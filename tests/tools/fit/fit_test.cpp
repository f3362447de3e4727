// `articular fit` as a user runs it: on a bar that hangs, and goes down by ρ g L²/2E.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/tools/support/program.hpp"

namespace articular::fit_test {

const std::string kHead =
    "title = 'Bar'\nscenario = '" ARTICULAR_SOURCE_DIR
    "/scenarios/verification/hanging_beam.toml'\n"
    "set = { analysis = 'static', duration = '1 s', 'integrator.step' = '1 s', "
    "'output.interval' = '1 s', 'body.beam.material.poisson_ratio' = 0, "
    "'body.beam.geometry.box.cells' = [1, 1, 5] }\n";
const std::string kModulus =
    "[[parameter]]\nname = 'modulus'\npath = 'body.beam.material.young_modulus'\n"
    "start = '30 kPa'\ndifference_step = '0.1 kPa'\nlowest = '5 kPa'\n";

std::string sag(const std::string& name, double value, const std::string& more = "") {
  std::ostringstream text;
  text << "[[measurement]]\nname = '" << name
       << "'\ncolumn = 'end.position.z [mm]'\nat = '1 s'\nminus = '0 s'\nvalue = " << value
       << "\nspread = 0.01\n"
       << more;
  return text.str();
}

std::vector<std::string> cells_of_row(const std::string& table, const std::string& first) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(first + ",")) continue;
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    return cells;
  }
  return {};
}

/// The way of the bar's end with its modulus in the file, 20 kPa, by the program itself.
double shipped_way(const TemporaryFolder& folder) {
  folder.file("twin.toml", kHead +
                               "[[parameter]]\nname = 'p'\npath = "
                               "'body.beam.material.young_modulus'\nstart = '20 kPa'\n"
                               "spread = '1e-3 Pa'\n" +
                               sag("sag", 0));
  run_program(folder, "fit twin.toml --out twin --quiet --iterations 1");
  return std::stod(cells_of_row(content(folder / "twin/measurements.csv"), "sag").at(6));
}

// A twin: measured is what the scenario gives with a modulus of 20 kPa, which is found again, and
// with it what is held out.
TEST(Fit, FindsTheParameterOfATwinAgain) {
  const TemporaryFolder folder;
  const double way = shipped_way(folder);
  EXPECT_NEAR(way, -2.4525, 0.2);
  folder.file("f.toml",
              kHead + kModulus + sag("sag", way) + sag("other", way, "held_out = true\n"));
  const ProgramResult result = run_program(folder, "fit f.toml --jobs 2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "out/f/fit.md\nout/f/measurements.csv\nout/f/parameters.csv\nout/f/fitted.txt\n");
  const auto modulus = cells_of_row(content(folder / "out/f/parameters.csv"), "modulus");
  ASSERT_EQ(modulus.size(), 10u);
  EXPECT_NEAR(std::stod(modulus[7]), 20, 0.01);
  // way = c/E: dE = E dway/way.
  EXPECT_NEAR(std::stod(modulus[8]), 20 * 0.01 / -way, 1e-2 * 20 * 0.01 / -way);
  const auto other = cells_of_row(content(folder / "out/f/measurements.csv"), "other");
  EXPECT_NEAR(std::stod(other[7]), way, 2e-3);
  const std::string text = content(folder / "out/f/fit.md");
  EXPECT_NE(text.find("Converged in"), std::string::npos) << text;
  EXPECT_NE(text.find("## Held out"), std::string::npos) << text;

  // Again: nothing runs. What was found can be run.
  EXPECT_EQ(run_program(folder, "fit f.toml --jobs 2").err.find("done"), std::string::npos);
  const ProgramResult run = run_program(
      folder,
      "run '" ARTICULAR_SOURCE_DIR
      "/scenarios/verification/hanging_beam.toml' --set @out/f/fitted.txt --out again --quiet");
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

// A measurement that says next to nothing leaves what was known, wherever the search begins.
TEST(Fit, GoesToWhatIsKnownFromAnotherStart) {
  const TemporaryFolder folder;
  folder.file("f.toml",
              kHead +
                  "[[parameter]]\nname = 'modulus'\npath = "
                  "'body.beam.material.young_modulus'\nstart = '25 kPa'\nknown = '20 kPa'\n"
                  "spread = '2 kPa'\n[[measurement]]\nname = 'm'\ncolumn = "
                  "'end.position.z [mm]'\nat = '1 s'\nvalue = -101\nspread = 1e4\n");
  const ProgramResult result = run_program(folder, "fit f.toml --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto modulus = cells_of_row(content(folder / "out/f/parameters.csv"), "modulus");
  EXPECT_EQ(modulus.at(2), "25");
  EXPECT_EQ(modulus.at(3), "20");
  EXPECT_NEAR(std::stod(modulus.at(7)), 20, 0.01);
}

TEST(Fit, SaysThatItDidNotConverge) {
  const TemporaryFolder folder;
  folder.file("f.toml", kHead + kModulus + sag("sag", -2.6));
  const ProgramResult result = run_program(folder, "fit f.toml --iterations 1");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("not converged after 1 iterations"), std::string::npos) << result.err;
  EXPECT_NE(content(folder / "out/f/fit.md").find("**Not converged**"), std::string::npos);
}

TEST(Fit, AScenarioThatDoesNotRunIsAnErrorWithTheReason) {
  const TemporaryFolder folder;
  folder.file("f.toml", kHead +
                            "[[run]]\nname = 'apart'\nset = { 'integrator.max_iterations' = 1, "
                            "'load.0.acceleration' = '0 0 -9e5 m/s^2', "
                            "'body.beam.material.law' = 'neo-hookean' }\n" +
                            kModulus + sag("sag", -2.6));
  const ProgramResult result = run_program(folder, "fit f.toml");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("does not run with these parameters: start: could not go on"),
            std::string::npos)
      << result.err;
}

TEST(Fit, AMistypedColumnEndsItAtTheFirstRun) {
  const TemporaryFolder folder;
  folder.file("f.toml", kHead + kModulus +
                            "[[measurement]]\nname = 'm'\ncolumn = 'end.position.x [m]'\nat = '1 "
                            "s'\nvalue = 1\nspread = 1\n");
  const ProgramResult result = run_program(folder, "fit f.toml");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("did you mean `end.position.x [mm]`"), std::string::npos) << result.err;
}

// By the slope at 30 kPa the bar would hang down by 9 mm with a modulus below zero, which the user
// never wrote.
TEST(Fit, AParameterThatLeavesItsRangeIsNamed) {
  const TemporaryFolder folder;
  folder.file("f.toml", kHead +
                            "[[parameter]]\nname = 'modulus'\npath = "
                            "'body.beam.material.young_modulus'\nstart = '30 kPa'\n"
                            "spread = '50 kPa'\n" +
                            sag("sag", -9));
  const ProgramResult result = run_program(folder, "fit f.toml --quiet");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err.rfind("articular: f.toml: parameter `modulus` went to -", 0), 0u)
      << result.err;
  EXPECT_NE(result.err.find(" kPa, where the scenario can't be run; give `lowest` or `highest`. "
                            "What it says: --set"),
            std::string::npos)
      << result.err;
}

// Best is their mean, -2.6 mm: 0.7 mm from the one, and 0.4 and 0.3 mm from the others.
TEST(Fit, SaysWhichMeasurementsItMisses) {
  const TemporaryFolder folder;
  folder.file("f.toml", kHead + kModulus + sag("less", -2.2) + sag("a bit less", -2.3) +
                            sag("more", -3.3) + sag("not fitted", -9, "held_out = true\n"));
  const ProgramResult result = run_program(folder, "fit f.toml --quiet");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.rfind("articular: warning: missed: `more` by ", 0), 0u) << result.err;
  EXPECT_NE(result.err.find(" spreads, `less` by -"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("not fitted"), std::string::npos) << result.err;
  EXPECT_NE(content(folder / "out/f/fit.md").find("\n**Missed**: `more` by "), std::string::npos);
}

// The line from nothing to the whole weight would give the half of it.
TEST(Fit, AStaticRunIsAskedForItsLoadStepsAlone) {
  const TemporaryFolder folder;
  folder.file("f.toml", kHead + kModulus +
                            "[[measurement]]\nname = 'm'\ncolumn = 'end.position.z [mm]'\nat = "
                            "'0.5 s'\nvalue = -101\nspread = 1\n");
  const ProgramResult result = run_program(folder, "fit f.toml --quiet");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("no equilibrium at 0.5 s; the nearest are at 0 and 1 s"),
            std::string::npos)
      << result.err;
}

// What a fit asks of its runs.
TEST(Frames, CanBeLeftOut) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(
      folder, "run '" ARTICULAR_SOURCE_DIR
              "/scenarios/verification/hanging_beam.toml' --set analysis=static "
              "--set output.frames=false --set duration='1 s' --set integrator.step='1 s' --out o "
              "--quiet");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "o/history.csv\no/summary.json\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "o/hanging_beam.pvd"));
  EXPECT_NE(content(folder / "o/history.csv").find("\n1,"), std::string::npos);
}

TEST(OverrideFiles, LinesStandForOverridesAndMistakesHaveTheirLine) {
  const TemporaryFolder folder;
  const std::string scenario =
      "'" ARTICULAR_SOURCE_DIR "/scenarios/verification/hanging_beam.toml'";
  folder.file("good", "\xEF\xBB\xBF# a remark\n\n  duration=\"2 s\"\r\n");
  EXPECT_NE(run_program(folder, "explain --json " + scenario + " --set @good").out.find("2.0"),
            std::string::npos);
  folder.file("bad", "# a remark\nduration\n");
  const ProgramResult bad = run_program(folder, "check " + scenario + " --set @bad");
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.err.find("bad:2: expected PATH=VALUE"), std::string::npos) << bad.err;
  EXPECT_EQ(run_program(folder, "check " + scenario + " --set @none").exit_code, 2);
}

}  // namespace articular::fit_test
