#include "tools/plot/axis_unit.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace articular::tools::axis_unit_test {

void expect_shown(const char* unit, double largest, double factor, const char* text) {
  const ShownUnit shown = shown_unit(axis_unit(unit), largest);
  EXPECT_NEAR(shown.factor, factor, 1e-12 * factor) << unit << " " << largest;
  EXPECT_EQ(shown.text, text) << unit << " " << largest;
}

TEST(AxisUnit, HasDimensionAndSize) {
  EXPECT_EQ(axis_unit("mm").dimension, axis_unit("km").dimension);
  EXPECT_DOUBLE_EQ(axis_unit("N mm").size, 1e-3);
  EXPECT_FALSE(axis_unit("N").dimension == axis_unit("N m").dimension);
  for (const char* none : {"-", "", " ", "%"})
    EXPECT_EQ(axis_unit(none).dimension, sim::Dimension{});
  EXPECT_DOUBLE_EQ(axis_unit("%").size, 0.01);
  EXPECT_THROW(axis_unit("furlong"), std::invalid_argument);
}

TEST(ShownUnit, OfAShortRunIsMilliseconds) {
  expect_shown("s", 0.45, 1e3, "ms");
  expect_shown("s", 1, 1, "s");
}

TEST(ShownUnit, MakesNumbersShort) {
  expect_shown("Pa", 2.5e6, 1e-6, "MPa");
  expect_shown("Pa", 900, 1, "Pa");
  expect_shown("N", 1000, 1, "N");
  expect_shown("N", 12000, 1e-3, "kN");
  expect_shown("J", 0.02, 1e3, "mJ");
  expect_shown("J", 3e-6, 1e6, "10⁻⁶ J");
  expect_shown("mm", 2e5, 1e-3, "10³ mm");
  expect_shown("-", 4e-5, 1e6, "10⁻⁶");
  expect_shown("mm", 0, 1, "mm");
}

TEST(ShownUnit, IsTypeset) {
  expect_shown("mm^2", 5, 1, "mm²");
  expect_shown("N m", 5, 1, "N·m");
  expect_shown("J/m^3", 5, 1, "J/m³");
  expect_shown("kg m^-1", 5, 1, "kg·m⁻¹");
  expect_shown("-", 5, 1, "");
}

}  // namespace articular::tools::axis_unit_test
