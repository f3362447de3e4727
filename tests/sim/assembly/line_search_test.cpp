#include "sim/assembly/line_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace articular::sim::line_search_test {

TEST(LineSearch, TakesAllOfACorrectionToTheLowestPoint) {
  EXPECT_EQ(searched_part(1, -3, [](double part) { return 3 * (part - 1); }), 1);
  EXPECT_EQ(searched_part(0.25, -3, [](double part) { return 3 * (part - 1); }), 0.25);
}

// A contact closes at a tenth of the way.
TEST(LineSearch, StopsWhereAContactHasTurnedTheSlope) {
  const auto slope = [](double part) { return part - 1 + 1e3 * std::max(0.0, part - 0.1); };
  const double part = searched_part(1, slope(0), slope);
  EXPECT_GT(part, 0.09);
  EXPECT_LE(slope(part), 0.8);
}

TEST(LineSearch, ComesBackFromWhereNothingCanBe) {
  const auto slope = [](double part) {
    return part > 0.3 ? std::numeric_limits<double>::quiet_NaN() : part - 1;
  };
  const double part = searched_part(1, slope(0), slope);
  EXPECT_LE(part, 0.3);
  EXPECT_GT(part, 0.05);
}

TEST(LineSearch, DoesNotLookUphill) {
  const auto never = [](double) -> double { throw std::logic_error("looked"); };
  EXPECT_EQ(searched_part(0.5, 1, never), 0.5);
}

}  // namespace articular::sim::line_search_test
