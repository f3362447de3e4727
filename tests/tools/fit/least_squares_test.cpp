// Least squares within bounds, on problems whose answers are known.
#include "tools/fit/least_squares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace articular::tools::least_squares_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Rosenbrock's valley: r = (10 (y - x²), 1 - x), least at (1, 1).
LeastSquaresProblem valley() {
  LeastSquaresProblem problem;
  problem.start = Eigen::Vector2d(-1.2, 1);
  problem.lowest = VectorXd::Constant(2, -kInfinite);
  problem.highest = VectorXd::Constant(2, kInfinite);
  problem.residuals = 2;
  problem.most_iterations = 100;
  problem.tolerance = 1e-10;
  problem.evaluate = [](const VectorXd& x, VectorXd& r) {
    r = Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]);
    return true;
  };
  problem.differentiate = [](const VectorXd& x, MatrixXd& j) {
    j.resize(2, 2);
    j << -20 * x[0], 10, -1, 0;
    return true;
  };
  return problem;
}

TEST(LeastSquares, FindsTheEndOfAValley) {
  const LeastSquaresSolution solution = minimise(valley());
  EXPECT_TRUE(solution.converged) << solution.message;
  EXPECT_LT((solution.x - Eigen::Vector2d(1, 1)).norm(), 1e-6);
}

// On x <= 1/2 the sum is least at (1/2, 1/4).
TEST(LeastSquares, StaysWithinBounds) {
  LeastSquaresProblem problem = valley();
  problem.highest[0] = 0.5;
  const LeastSquaresSolution solution = minimise(problem);
  EXPECT_TRUE(solution.converged) << solution.message;
  EXPECT_LT((solution.x - Eigen::Vector2d(0.5, 0.25)).norm(), 1e-5);
}

/// r = (x - 3, 10 (x² + y² - 4), y), the second a limit: least on the circle of radius 2, near (2,
/// 0).
LeastSquaresProblem outside_a_circle(double start) {
  LeastSquaresProblem problem = valley();
  problem.start = Eigen::Vector2d(start, 0.5);
  problem.residuals = 3;
  problem.limits = {false, true, false};
  problem.evaluate = [](const VectorXd& x, VectorXd& r) {
    r = Eigen::Vector3d(x[0] - 3, 10 * (x.squaredNorm() - 4), x[1]);
    return true;
  };
  problem.differentiate = [](const VectorXd& x, MatrixXd& j) {
    j.resize(3, 2);
    j << 1, 0, 20 * x[0], 20 * x[1], 0, 1;
    return true;
  };
  return problem;
}

// There x - 3 + 200 x (x² - 4) is 0: x = 2 + e with e = (1 - e) / (200 (2 + e)(4 + e)), so e =
// 1/1600 up to its square.
TEST(LeastSquares, EndsWhereALimitBeginsToBreak) {
  for (const double start : {-1.0, 0.5, 2.5}) {
    const LeastSquaresSolution solution = minimise(outside_a_circle(start));
    EXPECT_TRUE(solution.converged) << solution.message;
    EXPECT_NEAR(solution.x[0], 2 + 1.0 / 1600, 1e-5) << start;
    EXPECT_NEAR(solution.x[1], 0, 1e-5) << start;
  }
}

// From inside of the circle a step that does not see the limit goes to x = 3, where it is broken by
// fifty.
TEST(LeastSquares, AStepSeesALimitThatHolds) {
  LeastSquaresProblem problem = outside_a_circle(1.9);
  double farthest = 0;
  problem.evaluate = [&, inner = problem.evaluate](const VectorXd& x, VectorXd& r) {
    farthest = std::max(farthest, x[0]);
    return inner(x, r);
  };
  EXPECT_TRUE(minimise(problem).converged);
  EXPECT_LT(farthest, 2.05);
}

// The limit does not count where it holds: without anything that pulls at it nothing moves.
TEST(LeastSquares, ALimitThatHoldsDoesNotPull) {
  LeastSquaresProblem problem = outside_a_circle(1);
  problem.evaluate = [](const VectorXd& x, VectorXd& r) {
    r = Eigen::Vector3d(x[0] - 1, 10 * (x.squaredNorm() - 4), x[1]);
    return true;
  };
  const LeastSquaresSolution solution = minimise(problem);
  EXPECT_TRUE(solution.converged);
  EXPECT_LT((solution.x - Eigen::Vector2d(1, 0)).norm(), 1e-6);
}

// A bound and a limit at once: x <= 1 holds it back from the circle.
TEST(LeastSquares, ABoundHoldsBeforeALimit) {
  LeastSquaresProblem problem = outside_a_circle(0.2);
  problem.highest[0] = 1;
  const LeastSquaresSolution solution = minimise(problem);
  EXPECT_TRUE(solution.converged);
  EXPECT_EQ(solution.x[0], 1);
  EXPECT_NEAR(solution.x[1], 0, 1e-6);
}

// What lies farther than 0.3 from where it is can't be computed: steps are made shorter.
TEST(LeastSquares, GoesRoundWhereThereIsNothing) {
  LeastSquaresProblem problem = valley();
  int failed = 0;
  VectorXd at = problem.start;
  problem.evaluate = [&, inner = problem.evaluate](const VectorXd& x, VectorXd& r) {
    if ((x - at).norm() > 0.3) {
      ++failed;
      return false;
    }
    return inner(x, r);
  };
  problem.differentiate = [&, inner = problem.differentiate](const VectorXd& x, MatrixXd& j) {
    at = x;
    return inner(x, j);
  };
  const LeastSquaresSolution solution = minimise(problem);
  EXPECT_GT(failed, 0);
  EXPECT_TRUE(solution.converged) << solution.message;
  EXPECT_LT((solution.x - Eigen::Vector2d(1, 1)).norm(), 1e-6);
}

TEST(LeastSquares, EndsAtTheMostIterationsAndSaysSo) {
  LeastSquaresProblem problem = valley();
  problem.most_iterations = 3;
  const LeastSquaresSolution solution = minimise(problem);
  EXPECT_FALSE(solution.converged);
  EXPECT_LE(solution.iterations, 3);
}

TEST(LeastSquares, ThrowsWhatTheFunctionsThrow) {
  LeastSquaresProblem problem = valley();
  problem.evaluate = [](const VectorXd&, VectorXd&) -> bool { throw std::runtime_error("stop"); };
  EXPECT_THROW(minimise(problem), std::runtime_error);
}

}  // namespace articular::tools::least_squares_test
