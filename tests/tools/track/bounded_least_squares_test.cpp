// Least squares within bounds: what holds at the solution decides whether it is one.
#include "tools/track/bounded_least_squares.hpp"

#include <gtest/gtest.h>

#include <random>

namespace articular::tools::bounded_least_squares_test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(BoundedLeastSquares, IsTheFreeSolutionWhereThatLiesWithin) {
  MatrixXd A(3, 2);
  A << 1, 0, 0, 2, 1, 1;
  const VectorXd expected = Eigen::Vector2d(0.25, 0.5);
  const VectorXd x = bounded_least_squares(A, A * expected, VectorXd::Zero(2), VectorXd::Ones(2));
  EXPECT_LT((x - expected).norm(), 1e-12);
}

// x0 = 2 would be best, and with x0 = 1 the other takes over its part: 3 - 1.
TEST(BoundedLeastSquares, WhatABoundStopsOthersTakeOver) {
  MatrixXd A(2, 2);
  A << 1, 1, 1, 0;
  const VectorXd x =
      bounded_least_squares(A, Eigen::Vector2d(3, 2), VectorXd::Zero(2), Eigen::Vector2d(1, 10));
  EXPECT_LT((x - Eigen::Vector2d(1, 2)).norm(), 1e-12);
}

// Of any problem: the sum falls nowhere within the bounds [Kuhn 1951].
TEST(BoundedLeastSquares, TheSumFallsInNoDirectionThatIsAllowed) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  int at_bounds = 0, within = 0;
  for (int k = 0; k < 200; ++k) {
    const Index n = 1 + k % 12;
    const MatrixXd A = MatrixXd::NullaryExpr(n + 2, n, [&] { return normal(generator); });
    const VectorXd b = VectorXd::NullaryExpr(n + 2, [&] { return 3 * normal(generator); });
    const VectorXd lowest = VectorXd::Zero(n), highest = VectorXd::Ones(n);
    const VectorXd x = bounded_least_squares(A, b, lowest, highest);
    const VectorXd slope = A.transpose() * (A * x - b);
    for (Index i = 0; i < n; ++i) {
      ASSERT_GE(x[i], 0);
      ASSERT_LE(x[i], 1);
      const bool is_free = x[i] > 0 && x[i] < 1;
      EXPECT_TRUE(x[i] == 1 || slope[i] > -1e-9) << slope[i];
      EXPECT_TRUE(x[i] == 0 || slope[i] < 1e-9) << slope[i];
      (is_free ? within : at_bounds) += 1;
    }
  }
  EXPECT_GT(at_bounds, 200);
  EXPECT_GT(within, 200);
}

}  // namespace articular::tools::bounded_least_squares_test
