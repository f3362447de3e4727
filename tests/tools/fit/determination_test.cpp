// What measurements say of parameters, against closed forms.
#include "tools/fit/determination.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace articular::tools::determination_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A straight line a + b x through n points: var(b) = s²/Sxx, var(a) = s² (1/n + mean²/Sxx),
// cov = -s² mean/Sxx [Draper, Smith 1998, ch. 1].
TEST(Determination, OfAStraightLineIsThatOfTheTextbook) {
  const VectorXd x = VectorXd::LinSpaced(5, 1, 5);
  MatrixXd jacobian(5, 2);
  jacobian << VectorXd::Ones(5), x;
  const Determination d = determine(jacobian, VectorXd::Constant(2, kInfinite), VectorXd::Zero(5));
  const double mean = 3, sxx = 10;
  EXPECT_NEAR(d.widths[1], std::sqrt(1 / sxx), 1e-12);
  EXPECT_NEAR(d.widths[0], std::sqrt(1.0 / 5 + mean * mean / sxx), 1e-12);
  EXPECT_NEAR(d.correlation(0, 1), -mean / std::sqrt(sxx / 5 + mean * mean), 1e-12);
  EXPECT_EQ(d.from_data, VectorXd::Ones(2));
}

// One unknown known to s and measured with 1/j: 1/width² = 1/s² + j².
TEST(Determination, KnowledgeAndMeasurementAddTheirInverseVariances) {
  const double s = 0.5, j = 3;
  const Determination d =
      determine(MatrixXd::Constant(1, 1, j), VectorXd::Constant(1, s), VectorXd::Zero(1));
  const double width = 1 / std::sqrt(1 / (s * s) + j * j);
  EXPECT_NEAR(d.widths[0], width, 1e-12);
  EXPECT_NEAR(d.from_data[0], 1 - width * width / (s * s), 1e-12);
  EXPECT_NEAR(d.singular_values[0], j * s, 1e-12);
}

// Only the sum of two is measured: neither is known, or as well as before; the third is.
TEST(Determination, WhatIsNotMeasuredIsNotDetermined) {
  MatrixXd jacobian(2, 3);
  jacobian << 1, 1, 0, 0, 0, 2;
  VectorXd spreads = VectorXd::Constant(3, kInfinite);
  Determination d = determine(jacobian, spreads, VectorXd::Zero(2));
  EXPECT_TRUE(std::isinf(d.widths[0]) && std::isinf(d.widths[1]));
  EXPECT_NEAR(d.widths[2], 0.5, 1e-12);
  EXPECT_EQ(d.correlation(0, 1), 0);
  EXPECT_EQ(d.determined, 2);
  spreads = VectorXd::Constant(3, 100);
  d = determine(jacobian, spreads, VectorXd::Zero(2));
  EXPECT_NEAR(d.widths[0], 100 / std::sqrt(2), 0.01);
  EXPECT_NEAR(d.correlation(0, 1), -1, 1e-3);
  EXPECT_NEAR(d.from_data[0], 0.5, 1e-3);
}

// Misfits of two spreads on average, three measurements more than unknowns.
TEST(Determination, LargeMisfitsWidenAndSmallOnesDoNot) {
  const MatrixXd jacobian = MatrixXd::Ones(4, 1);
  const VectorXd spreads = VectorXd::Constant(1, kInfinite);
  const Determination small = determine(jacobian, spreads, VectorXd::Constant(4, 0.1));
  EXPECT_NEAR(small.widths[0], 0.5, 1e-12);
  const Determination large = determine(jacobian, spreads, VectorXd::Constant(4, 2));
  EXPECT_NEAR(large.scale, 4 / std::sqrt(3), 1e-12);
  EXPECT_NEAR(large.widths[0], large.scale * 0.5, 1e-12);
}

}  // namespace articular::tools::determination_test
