#include "tools/render/colour_scale.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "tools/render/survey.hpp"

namespace articular::tools::render_test {

Survey stress_up_to(double highest) {
  Survey survey;
  survey.field = "von_mises";
  survey.unit = "Pa";
  survey.coloured = {"disc"};
  survey.highest = survey.high_percentile = highest;
  return survey;
}

std::string range_error(const Survey& survey, const AskedRange& range,
                        const std::string& map = "") {
  try {
    field_scale(survey, range, map);
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FieldScale, EndsAtARoundNumberInAUnitOfItsSize) {
  EXPECT_EQ(range_text(field_scale(stress_up_to(810), {}, "")), "0 to 1000 Pa");
  EXPECT_EQ(range_text(field_scale(stress_up_to(2900), {}, "")), "0 to 3 kPa");
  EXPECT_EQ(range_text(field_scale(stress_up_to(7.1e6), {}, "")), "0 to 8 MPa");
}

TEST(FieldScale, GoesToBothSidesOfRestWhereValuesDo) {
  Survey survey = stress_up_to(0);
  survey.field = "volume_ratio";
  survey.unit = "1";
  survey.rest = 1;
  survey.lowest = 0.8;
  survey.highest = 1.1;
  survey.high_percentile = 0.2;
  EXPECT_EQ(range_text(field_scale(survey, {}, "")), "0.8 to 1.2");
  survey.lowest = 0.9999;  // hardly
  const ColourScale one_sided = field_scale(survey, {}, "");
  EXPECT_EQ(range_text(one_sided), "1 to 1.1");
  EXPECT_DOUBLE_EQ(*one_sided.lowest_below, 0.9999);
}

TEST(FieldScale, SaysWhatLiesBeyondItsEnds) {
  const ColourScale all = field_scale(stress_up_to(3000), {}, "");
  EXPECT_FALSE(all.highest_above);
  EXPECT_FALSE(all.lowest_below);
  const ColourScale cut = field_scale(stress_up_to(3000), AskedRange{"1 kPa", "2 kPa"}, "");
  EXPECT_DOUBLE_EQ(*cut.highest_above, 3);
  EXPECT_DOUBLE_EQ(*cut.lowest_below, 0);
}

TEST(FieldScale, TakesARangeInAnyUnitOfTheField) {
  const ColourScale scale = field_scale(stress_up_to(3000), AskedRange{"0", "0.002 MPa"}, "magma");
  EXPECT_EQ(range_text(scale), "0 to 0.002 MPa");
  EXPECT_DOUBLE_EQ(scale.factor, 1e-6);
  EXPECT_EQ(range_text(field_scale(stress_up_to(3000), AskedRange{"500 Pa", "2 kPa"}, "")),
            "0.5 to 2 kPa");
  EXPECT_EQ(range_text(field_scale(stress_up_to(3000), AskedRange{"-2 kPa", "0"}, "")),
            "-2 to 0 kPa");
}

TEST(FieldScale, RefusesWhatIsNoRange) {
  const Survey stress = stress_up_to(3000);
  EXPECT_EQ(range_error(stress, {"0", "2"}),
            "--range 2: von_mises is in Pa; expected a number with its unit, e.g. \"2 Pa\"");
  EXPECT_EQ(range_error(stress, {"0", "much"}),
            "--range: expected a number with its unit, not `much`");
  EXPECT_EQ(range_error(stress, {"0", "2 mm"}),
            "--range: von_mises is in Pa; expected such a unit, not `mm`");
  EXPECT_EQ(range_error(stress, {"0", "2 kPaa"}).rfind("--range: von_mises is in Pa; ", 0), 0U);
  EXPECT_EQ(range_error(stress, {"2 kPa", "1 kPa"}),
            "--range 2 kPa 1 kPa: expected the low end first, then a higher one");
  EXPECT_EQ(range_error(stress, {"0", "2 kPa"}, "virids")
                .rfind("--colour-map: unknown colour map `virids`, did you mean `viridis`?", 0),
            0U);
  Survey ratio = stress;
  ratio.unit = "1";
  EXPECT_EQ(range_error(ratio, {"0", "2 kPa"}),
            "--range: von_mises has no unit; expected numbers alone");
}

TEST(FieldScale, EndsAtRoundNumbers) {
  EXPECT_EQ(round_up(0), 1);
  EXPECT_EQ(round_up(1), 1);
  EXPECT_DOUBLE_EQ(round_up(0.0123), 0.015);
  EXPECT_EQ(round_up(81), 100);
}

}  // namespace articular::tools::render_test
