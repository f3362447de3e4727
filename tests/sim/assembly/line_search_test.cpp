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

// A contact closes somewhere on the way. Going on from a tenth of what is left is not enough: the
// next correction would meet the same contact.
TEST(LineSearch, GoesToAboutWhereAContactTurnsTheSlope) {
  for (const double closes : {0.01, 0.1, 0.3, 0.7, 0.95})
    for (const double stiffness : {10.0, 1e3, 1e5}) {
      const auto slope = [&](double part) {
        return part - 1 + stiffness * std::max(0.0, part - closes);
      };
      const double part = searched_part(1, slope(0), slope);
      EXPECT_LE(slope(part), 0.8);
      EXPECT_GE(part, std::min(0.5, 0.9 * closes)) << closes << ", " << stiffness;
    }
}

// Few looks do, however steep it is.
TEST(LineSearch, LooksAtMostEightTimes) {
  int looks = 0;
  const auto slope = [&](double part) {
    ++looks;
    return part < 1e-12 ? -1.0 : 1e20;
  };
  const double part = searched_part(1, -1, slope);
  EXPECT_EQ(looks, 8);
  EXPECT_GT(part, 0);
  EXPECT_LE(part, 1e-7);
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
