#include "tools/sampling/distribution.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace articular::tools::distribution_test {

using Kind = Distribution::Kind;

/// Mean and standard deviation by the midpoint rule over the quantiles.
std::pair<double, double> moments(const Distribution& d) {
  constexpr int kPoints = 20000;
  double sum = 0, squares = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double x = quantile(d, (i + 0.5) / kPoints);
    sum += x;
    squares += x * x;
  }
  const double mean = sum / kPoints;
  return {mean, std::sqrt(squares / kPoints - mean * mean)};
}

TEST(Distribution, HasTheMeanAndTheSpreadThatItIsGiven) {
  for (const Kind kind : {Kind::Normal, Kind::Lognormal}) {
    const auto [mean, sd] = moments({kind, 12, 3});
    EXPECT_NEAR(mean, 12, 0.001);  // tails beyond the last midpoint are left out
    EXPECT_NEAR(sd, 3, 0.01);
  }
  const auto [mean, sd] = moments({Kind::Uniform, 0, 1, 2, 8});
  EXPECT_NEAR(mean, 5, 1e-9);
  EXPECT_NEAR(sd, 6 / std::sqrt(12), 1e-6);
}

// 0.975 of a normal distribution lies below mean + 1.959964 sd; the median of a lognormal one is
// mean² / sqrt(mean² + sd²).
TEST(Distribution, QuantilesAreThoseOfTables) {
  EXPECT_NEAR(quantile({Kind::Normal, 10, 2}, 0.975), 10 + 2 * 1.959963985, 1e-8);
  EXPECT_NEAR(quantile({Kind::Lognormal, 10, 2}, 0.5), 100 / std::sqrt(104.0), 1e-12);
}

// A half of a normal distribution: mean sd sqrt(2/pi) above where it is cut.
TEST(Distribution, CutOffItKeepsItsShape) {
  const Distribution half{Kind::Normal, 0, 1, 0};
  EXPECT_NEAR(kept_share(half), 0.5, 1e-15);
  EXPECT_NEAR(moments(half).first, std::sqrt(2 / M_PI), 1e-3);
  const Distribution both{Kind::Lognormal, 1, 0.5, 0.8, 1.1};
  for (const double p : {1e-9, 0.3, 1 - 1e-9}) {
    EXPECT_GE(quantile(both, p), 0.8);
    EXPECT_LE(quantile(both, p), 1.1);
  }
}

}  // namespace articular::tools::distribution_test
