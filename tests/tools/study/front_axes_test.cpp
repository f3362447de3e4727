#include "tools/study/front_axes.hpp"

#include <gtest/gtest.h>

#include <set>

namespace articular::tools {

TEST(FrontAxes, HaveNumbersAtPowersOfTenAndBetweenThemWhereTheseAreFew) {
  EXPECT_EQ(axis_numbers('x', 0.8, 2000), "set xtics (1, 10, 100, 1000)\n");
  EXPECT_EQ(axis_numbers('x', 7, 60), "set xtics (10, 20, 50)\n");
  EXPECT_EQ(axis_numbers('y', 0.15, 0.6), "set ytics (0.2, 0.5)\n");
}

TEST(FrontAxes, NumbersOfNearCasesStandOnDifferentSides) {
  const std::vector<std::string> places = number_places({{0.5, 0.5}, {0.501, 0.5}, {0.502, 0.5}});
  EXPECT_EQ(std::set<std::string>(places.begin(), places.end()).size(), 3U);
  EXPECT_EQ(number_places({{0.1, 0.5}, {0.9, 0.5}}),
            (std::vector<std::string>{"left offset 0.5,0.5", "left offset 0.5,0.5"}));
}

}  // namespace articular::tools
