// Least squares within bounds, on problems whose answers are known.
#include "tools/fit/least_squares.hpp"

#include <gtest/gtest.h>

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
