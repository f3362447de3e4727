#include "tools/sampling/spread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace articular::tools::spread_test {

TEST(Spread, OfFewNumbersIsKnown) {
  const std::vector<double> values = known({4, std::nan(""), 1, 3, 2, INFINITY});
  EXPECT_EQ(values.size(), 4u);
  EXPECT_EQ(mean_of(values), 2.5);
  EXPECT_NEAR(sd_of(values), std::sqrt(5.0 / 3), 1e-15);
  EXPECT_EQ(quantile_of(values, 0), 1);
  EXPECT_EQ(quantile_of(values, 0.5), 2.5);
  EXPECT_EQ(quantile_of(values, 1), 4);
  EXPECT_EQ(sd_of({7}), 0);
}

TEST(Spread, AHistogramCountsEveryValueOnce) {
  std::vector<double> values;
  for (int i = 0; i < 200; ++i) values.push_back(std::sin(i));
  const Histogram histogram = histogram_of(values);
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), 0), 200);
  EXPECT_GE(histogram.counts.size(), 5u);
  EXPECT_NEAR(histogram.lowest + histogram.width * static_cast<double>(histogram.counts.size()),
              quantile_of(values, 1), 1e-12);
  EXPECT_EQ(histogram_of({3, 3, 3}).counts, std::vector<int>{3});
}

// Ranks do not see how far values are apart; equal ones share a rank.
TEST(Spread, RankCorrelationIsThatOfTheOrder) {
  EXPECT_NEAR(rank_correlation({1, 2, 3, 4}, {1, 10, 100, 1000}), 1, 1e-15);
  EXPECT_NEAR(rank_correlation({1, 2, 3, 4}, {8, 4, 2, 1}), -1, 1e-15);
  EXPECT_NEAR(rank_correlation({1, 2, 3, NAN, 4}, {1, 1, 2, 9, 2}), std::sqrt(0.8), 1e-15);
  EXPECT_TRUE(std::isnan(rank_correlation({1, 2, 3}, {5, 5, 5})));
}

}  // namespace articular::tools::spread_test
