// What a bar is made of, on sequences whose law is known.
#include "tools/error_bars/discretisation_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace articular::tools::discretisation_error_test {

constexpr double kFormal = 2;

/// exact + slope h^order.
std::vector<SizedValue> from_law(double exact, double slope, double order,
                                 const std::vector<double>& sizes) {
  std::vector<SizedValue> values;
  values.reserve(sizes.size());
  for (const double h : sizes) values.push_back({h, exact + slope * std::pow(h, order)});
  return values;
}

DiscretisationError of_values(double f1, double f2, double f3) {
  return discretisation_error(std::vector<SizedValue>{{1, f1}, {2, f2}, {4, f3}}, kFormal);
}

// The error of the finest is slope h^p, and the bar 1.25 times that, in any unit of sizes.
TEST(DiscretisationError, OfAPowerLawIsTheTrueOneWithItsSafety) {
  for (const double order : {0.7, 1.0, 1.6, 2.0})
    for (const double slope : {-0.3, 2.0})
      for (const auto& sizes : {std::vector<double>{1, 2, 4}, std::vector<double>{0.5, 0.8, 2},
                                std::vector<double>{3e-4, 4e-4, 7e-4}}) {
        const auto error = discretisation_error(from_law(5, slope, order, sizes), kFormal);
        const double true_error = std::abs(slope) * std::pow(sizes[0], order);
        EXPECT_NEAR(error.order, order, 1e-6);
        EXPECT_NEAR(error.bar, 1.25 * true_error, 1e-6 * true_error);
        EXPECT_EQ(error.doubt, "");
      }
}

// Errors whose sign differs from the value's, or values about zero, change nothing.
TEST(DiscretisationError, DoesNotDependOnWhereZeroIs) {
  for (const double exact : {-1.0, 0.0, 1e-3, 1e6}) {
    const auto error = discretisation_error(from_law(exact, -0.01, 2, {1, 1.5, 2.25}), kFormal);
    EXPECT_NEAR(error.bar, 1.25 * 0.01, 1e-8);
  }
}

// h^3 fakes an order of 3: the bar is that of the method's order, which is larger.
TEST(DiscretisationError, AnOrderAboveTheMethodsIsNotBelieved) {
  const auto error = discretisation_error(from_law(5, 1, 2.9, {1, 2, 4}), kFormal);
  EXPECT_NEAR(error.order, 2.9, 1e-9);
  EXPECT_NEAR(error.bar, 1.25 * (std::pow(2, 2.9) - 1) / 3, 1e-9);
  EXPECT_EQ(error.doubt, "");
}

TEST(DiscretisationError, AnOrderAboveThreeIsDoubtedAndTheSpreadCounts) {
  const auto error = discretisation_error(from_law(5, 1, 3.5, {1, 2, 4}), kFormal);
  EXPECT_TRUE(std::isnan(error.order));
  EXPECT_NEAR(error.bar, 1.25 * (std::pow(4, 3.5) - 1), 1e-9);
  EXPECT_EQ(error.doubt, "order above 3");
}

TEST(DiscretisationError, WhatGoesToAndFroHasItsSpread) {
  const auto error = of_values(1, 1.1, 0.7);
  EXPECT_NEAR(error.bar, 1.25 * 0.4, 1e-12);
  EXPECT_EQ(error.doubt, "goes to and fro");
  EXPECT_TRUE(std::isnan(error.order));
}

TEST(DiscretisationError, DifferencesThatGrowCountThreefold) {
  EXPECT_NEAR(of_values(1, 1.4, 1.3).bar, 3 * 0.4, 1e-12);  // to and fro
  EXPECT_EQ(of_values(1, 1.4, 1.3).doubt, "differences grow");
  EXPECT_NEAR(of_values(1, 2, 2.5).bar, 3 * 1.5, 1e-12);  // one way
  EXPECT_EQ(of_values(1, 2, 2.5).doubt, "hardly converges");
  EXPECT_NEAR(of_values(1, 2, 2).bar, 3 * 1, 1e-12);  // the coarser two agree
}

TEST(DiscretisationError, EvenStepsHardlyConverge) {
  const auto error = of_values(1, 2, 3);
  EXPECT_NEAR(error.bar, 3 * 2, 1e-12);
  EXPECT_EQ(error.doubt, "hardly converges");
}

// Two equal ones say little where the third differs.
TEST(DiscretisationError, StandingStillIsNoConvergence) {
  const auto error = of_values(1, 1, 1.2);
  EXPECT_NEAR(error.bar, 1.25 * 0.2, 1e-12);
  EXPECT_EQ(error.doubt, "stands still");
}

TEST(DiscretisationError, EqualValuesHaveNone) {
  const auto error = of_values(7, 7, 7);
  EXPECT_EQ(error.bar, 0);
  EXPECT_EQ(error.doubt, "");
}

TEST(DiscretisationError, OfTwoTakesTheMethodsOrderAndThreefoldSafety) {
  const auto error = discretisation_error(from_law(5, 0.1, 2, {1, 1.5}), kFormal);
  EXPECT_NEAR(error.bar, 3 * 0.1, 1e-12);
  EXPECT_EQ(error.doubt, "order 2 taken, not seen");
}

TEST(DiscretisationError, BlankCellsOfCoarserRunsAreLeftOut) {
  const auto error = of_values(1, kNoValue, 1.15);
  EXPECT_NEAR(error.bar, 3 * 0.15 / (16 - 1), 1e-12);
  EXPECT_EQ(error.doubt, "order 2 taken, not seen");
  EXPECT_TRUE(std::isnan(of_values(1, kNoValue, kNoValue).bar));
  EXPECT_EQ(of_values(1, kNoValue, kNoValue).doubt, "no value in the coarser runs");
}

TEST(DiscretisationError, OfNoValueIsNone) {
  EXPECT_TRUE(std::isnan(of_values(kNoValue, 1, 2).bar));
  EXPECT_EQ(of_values(kNoValue, 1, 2).doubt, "no value");
  EXPECT_TRUE(std::isnan(discretisation_error({}, kFormal).bar));
}

}  // namespace articular::tools::discretisation_error_test
