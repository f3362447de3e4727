// FIT.toml: what is read, and what is said of mistakes.
#include "tools/fit/fit_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::tools::fit_file_test {

const std::string kParameter =
    "[[parameter]]\nname = 'slack'\npath = 'ligament.a.slack_length'\nstart = '30 mm'\n"
    "spread = '0.2 cm'\n";
const std::string kMeasurement =
    "[[measurement]]\nname = 'drawer'\ncolumn = 'knee.anterior [mm]'\nat = '2 s'\nminus = '1 s'\n"
    "value = 4\nspread = 1.4\n";

Fit read(const std::string& text) {
  const TemporaryFolder folder;
  return read_fit(folder.file("f.toml", "scenario = 's.toml'\n" + text));
}

/// The message about a file, without the folder.
std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const sim::InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("f.toml"));
  }
  return "";
}

TEST(FitFile, NumbersAreInTheUnitOfTheStart) {
  const Fit fit = read(kParameter + "lowest = '25000 um'\n" + kMeasurement);
  ASSERT_EQ(fit.parameters.size(), 1u);
  const FitParameter& slack = fit.parameters[0];
  EXPECT_EQ(slack.unit, "mm");
  EXPECT_EQ(slack.start, 30);
  EXPECT_NEAR(slack.spread.value(), 2, 1e-12);
  EXPECT_NEAR(slack.lowest, 25, 1e-12);
  EXPECT_TRUE(std::isinf(slack.highest));
  EXPECT_NEAR(slack.step, 0.1, 1e-12);  // a twentieth of the spread
  const FitMeasurement& drawer = fit.measurements.at(0);
  EXPECT_EQ(drawer.at, 2);
  EXPECT_EQ(drawer.minus, 1);
  EXPECT_EQ(drawer.target, FitTarget::Value);
  EXPECT_FALSE(drawer.held_out);
}

TEST(FitFile, WhatIsKnownIsTheStartUnlessItIsGiven) {
  EXPECT_FALSE(read(kParameter + kMeasurement).parameters.at(0).known);
  EXPECT_NEAR(
      read(kParameter + "known = '31000 um'\n" + kMeasurement).parameters.at(0).known.value(), 31,
      1e-12);
}

TEST(FitFile, RunsHaveWhatIsSetForAllAndTheirOwn) {
  const Fit fit = read(
      "set = { duration = '1 s' }\n[[run]]\nname = 'cut'\nset = { 'choice.acl' = "
      "'cut' }\n[[run]]\nname = 'whole'\n" +
      kParameter + kMeasurement + "run = 'whole'\n");
  ASSERT_EQ(fit.runs.size(), 2u);
  EXPECT_EQ(fit.runs[0].settings.overrides,
            (std::vector<std::string>{"duration=\"1 s\"", "choice.acl=\"cut\""}));
  EXPECT_EQ(fit.measurements[0].run, 1u);
}

TEST(FitFile, MistakesAreNamedWithTheirPlace) {
  const struct {
    std::string text, message;
  } cases[] = {
      {kMeasurement, "`parameter` is missing"},
      {kParameter, "`measurement` is missing"},
      {kParameter + kMeasurement + "held_out = true\n", "all are held out"},
      {kParameter + "lowest = '31 mm'\n" + kMeasurement, "must lie between"},
      {kParameter + "lowest = 3\n" + kMeasurement, "expected a value in `mm`"},
      {kParameter + "lowest = '3 N'\n" + kMeasurement, "expected a value in `mm`"},
      {kParameter + "highest = '30.1 mm'\nlowest = '30 mm'\n" + kMeasurement,
       "more than two difference steps apart"},
      {kParameter + kMeasurement + "at_most = 3\n", "at_most"},
      {kParameter + kMeasurement + "run = 'x'\n", "no [[run]] `x`"},
      {kParameter + kParameter + kMeasurement, "a second one is called `slack`"},
      {kParameter +
           "[[parameter]]\nname = 'b'\npath = 'ligament.a.slack_length'\nstart = 1\n"
           "spread = 1\n" +
           kMeasurement,
       "`slack` changes `ligament.a.slack_length` too"},
      {"[[parameter]]\nname = 'a'\nstart = 1\nspread = 1\n" + kMeasurement,
       "parameter `a` changes nothing"},
      {"[[parameter]]\nname = 'a'\npath = 'x'\nstart = 1\n" + kMeasurement, "expected `spread`"},
      {"[[parameter]]\nname = 'a'\npath = 'x'\nstart = 1\nknown = 2\ndifference_step = 1\n" +
           kMeasurement,
       "expected `spread` with it"},
      {"[[parameter]]\nname = 'a b'\npath = 'x'\nstart = 1\nspread = 1\n" + kMeasurement,
       "expected a name of letters"},
      {"[[parameter]]\nname = 'a'\npath = 'x'\nstart = 'mm'\nspread = 1\n" + kMeasurement,
       "expected a number, or a number with a unit"},
      {"[[parameter]]\nname = 'a'\npath = 'x'\nstart = '2 mn'\nspread = '1 mn'\n" + kMeasurement,
       "mn"},
      {"set = { x = '{slak} mm' }\n" + kParameter + kMeasurement, "did you mean `slack`"},
      {"set = { x = '{slack} m' }\n" + kParameter + kMeasurement, "expected `{slack} mm`"},
  };
  for (const auto& [text, message] : cases) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find(message), std::string::npos) << text << "\n" << error;
    EXPECT_EQ(error.find("f.toml"), 0u) << error;
  }
}

}  // namespace articular::tools::fit_file_test
