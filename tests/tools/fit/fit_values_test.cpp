// What a run says of a measurement.
#include "tools/fit/fit_values.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"

namespace articular::tools::fit_values_test {

const RunHistory kHistory{{"time [s]", "a.force [N]", "b.force [N]", "way [mm]"},
                          {{0, 1, 2}, {0, 10, 30}, {1, 1, kNoValue}, {5, 6, 9}}};

FitMeasurement measurement(std::vector<std::string> columns, double at) {
  FitMeasurement m;
  m.name = "m";
  m.columns = std::move(columns);
  m.at = at;
  return m;
}

using Analysis = sim::Scenario::Analysis;

double value(const FitMeasurement& m, Analysis analysis = Analysis::Dynamic) {
  return measured_value(m, kHistory, analysis, "f.toml");
}

TEST(FitValues, AreSumsAndDifferencesBetweenRows) {
  EXPECT_EQ(value(measurement({"a.force [N]"}, 2)), 30);
  EXPECT_NEAR(value(measurement({"a.force [N]"}, 1.25)), 15, 1e-12);
  EXPECT_NEAR(value(measurement({"a.force [N]", "b.force [N]"}, 0.5)), 6, 1e-12);
  FitMeasurement difference = measurement({"way [mm]"}, 2);
  difference.minus = 0.5;
  EXPECT_NEAR(value(difference), 3.5, 1e-12);
}

TEST(FitValues, ARowCountsThoughTheNextIsEmpty) {
  EXPECT_EQ(value(measurement({"b.force [N]"}, 1)), 1);
}

// Between equilibria nothing was computed, and a line from one to the next may be far off.
TEST(FitValues, OfAStaticRunAreThoseOfItsRowsAlone) {
  EXPECT_EQ(value(measurement({"a.force [N]"}, 2), Analysis::Static), 30);
  EXPECT_EQ(value(measurement({"b.force [N]"}, 1 + 1e-9), Analysis::Static), 1);
  FitMeasurement between = measurement({"a.force [N]"}, 2);
  between.minus = 0.25;
  for (const FitMeasurement& m : {measurement({"a.force [N]"}, 0.25), between}) {
    try {
      value(m, Analysis::Static);
      ADD_FAILURE() << "not refused";
    } catch (const sim::InputError& e) {
      EXPECT_STREQ(e.what(),
                   "f.toml: measurement `m`: the static run has no equilibrium at 0.25 s; the "
                   "nearest are at 0 and 1 s. Choose one of them, or an `integrator.step` of which "
                   "0.25 s is a multiple");
    }
  }
}

TEST(FitValues, MistakesAreNamed) {
  const auto error = [](const FitMeasurement& m) -> std::string {
    try {
      value(m);
    } catch (const sim::InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(error(measurement({"a.froce [N]"}, 1)).find("did you mean `a.force [N]`"),
            std::string::npos);
  EXPECT_NE(error(measurement({"a.force [N]", "way [mm]"}, 1)).find("different units"),
            std::string::npos);
  EXPECT_NE(error(measurement({"a.force [N]"}, 2.1)).find("a time from 0 to 2 s"),
            std::string::npos);
  EXPECT_NE(error(measurement({"b.force [N]"}, 1.5)).find("is empty at 1.5 s"), std::string::npos);
}

TEST(FitValues, MisfitsAreInSpreadsAndOneSidedForLimits) {
  FitMeasurement m = measurement({"way [mm]"}, 0);
  m.value = 4;
  m.spread = 2;
  EXPECT_EQ(misfit(m, 7), 1.5);
  EXPECT_EQ(misfit(m, 1), -1.5);
  m.target = FitTarget::AtMost;
  EXPECT_EQ(misfit(m, 7), 1.5);
  EXPECT_EQ(misfit(m, 1), 0);
  m.target = FitTarget::AtLeast;
  EXPECT_EQ(misfit(m, 7), 0);
  EXPECT_EQ(misfit(m, 1), -1.5);
}

}  // namespace articular::tools::fit_values_test
