// Groups that are left out, and what is told of them.
#include "tools/fit/cross_validation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.hpp"
#include "tests/tools/support/program.hpp"

namespace articular::tools::cross_validation_test {

FitMeasurement measurement(const std::string& group, bool held_out = false) {
  FitMeasurement m;
  m.group = group;
  m.held_out = held_out;
  return m;
}

std::string error_of(const std::vector<FitMeasurement>& measurements) {
  Fit fit;
  fit.file = "f.toml";
  fit.measurements = measurements;
  try {
    check_groups(fit);
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CrossValidation, SomethingIsLeftOutAndSomethingIsLeft) {
  EXPECT_EQ(error_of({measurement("a"), measurement("b")}), "");
  EXPECT_EQ(error_of({measurement("a"), measurement("")}), "");
  EXPECT_NE(error_of({measurement(""), measurement("")}).find("no [[measurement]]"),
            std::string::npos);
  EXPECT_NE(error_of({measurement("a", true), measurement("")}).find("no [[measurement]]"),
            std::string::npos);
  EXPECT_NE(error_of({measurement("a"), measurement("a"), measurement("", true)})
                .find("without group `a` nothing is left"),
            std::string::npos);
}

// Three measurements of one way, whose best value is their mean: 2.6, and 2.25 and 3.3 mm where the
// group "other" or "one" is left out. Misfits are by a spread of 0.01 mm.
TEST(CrossValidation, AGroupIsOffByWhatTheOthersSay) {
  const TemporaryFolder folder;
  std::string text = "scenario = '" ARTICULAR_SOURCE_DIR
                     "/scenarios/verification/hanging_beam.toml'\n"
                     "set = { analysis = 'static', duration = '1 s', 'integrator.step' = '1 s', "
                     "'output.interval' = '1 s', 'body.beam.material.poisson_ratio' = 0, "
                     "'body.beam.geometry.box.cells' = [1, 1, 5] }\n"
                     "[[parameter]]\nname = 'modulus'\npath = 'body.beam.material.young_modulus'\n"
                     "start = '20 kPa'\ndifference_step = '0.1 kPa'\nlowest = '5 kPa'\n";
  const auto add = [&](const std::string& name, const std::string& value, const std::string& more) {
    text +=
        "[[measurement]]\nname = '" + name +
        "'\ncolumn = 'end.position.z [mm]'\nat = '1 s'\nminus = '0 s'\nspread = 0.01\nvalue = " +
        value + "\n" + more;
  };
  add("less", "-2.2", "group = 'one'\n");
  add("a bit less", "-2.3", "group = 'one'\n");
  add("more", "-3.3", "group = 'other'\n");
  add("no part of it", "-9", "group = 'other'\nheld_out = true\n");
  folder.file("f.toml", text);
  const ProgramResult result = run_program(folder, "fit f.toml --cross-validate --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string table = content(folder / "out/f/cross_validation.csv");
  double fitted = 0, left_out = 0;
  int count = 0;
  const auto read_row = [&](const std::string& group) {
    const std::size_t row = table.find("\n" + group + ",");
    ASSERT_NE(row, std::string::npos) << table;
    double start = 0;
    ASSERT_EQ(std::sscanf(table.c_str() + row + 2 + group.size(), "%d,%lf,%lf,%lf,yes", &count,
                          &start, &fitted, &left_out),
              4)
        << table;
  };
  // The fit to all ends where a step changes the sum, 7400, by less than 1e-3 of it: 1.6 spreads.
  constexpr double kDigits = 2;
  read_row("one");
  EXPECT_EQ(count, 2);
  EXPECT_NEAR(fitted, std::sqrt((40 * 40 + 30 * 30) / 2.0), kDigits);
  EXPECT_NEAR(left_out, std::sqrt((110 * 110 + 100 * 100) / 2.0), kDigits);
  read_row("other");
  EXPECT_EQ(count, 1);
  EXPECT_NEAR(fitted, 70, kDigits);
  EXPECT_NEAR(left_out, 105, kDigits);
  EXPECT_NE(content(folder / "out/f/fit.md").find("## Cross-validation"), std::string::npos);
}

TEST(CrossValidation, WithoutGroupsItIsRefusedBeforeAnyRun) {
  const TemporaryFolder folder;
  folder.file("f.toml",
              "scenario = 's.toml'\n[[parameter]]\nname = 'p'\npath = 'duration'\nstart = 1\n"
              "spread = 1\n[[measurement]]\nname = 'm'\ncolumn = 'a.force [N]'\nat = '1 s'\n"
              "value = 1\nspread = 1\n");
  const ProgramResult result = run_program(folder, "fit f.toml --cross-validate");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("f.toml: --cross-validate: no [[measurement]]"), std::string::npos)
      << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace articular::tools::cross_validation_test
