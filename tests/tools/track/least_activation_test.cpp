// Two muscles that share a load, with arms 1 and 2: a + 2 b = 1. What each cost makes of it is
// known in closed form.
#include "tools/track/least_activation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace articular::tools::least_activation_test {

using Eigen::VectorXd;

ActivationProblem shared_load() {
  ActivationProblem problem;
  problem.A = Eigen::RowVector2d(1, 2) * 1e3;
  problem.b = VectorXd::Constant(1, 1e3);
  problem.lowest = VectorXd::Zero(2);
  problem.highest = VectorXd::Ones(2);
  problem.count = VectorXd::Ones(2);
  problem.effort = 1e-3;
  return problem;
}

/// The load is met to effort/arm^2.
constexpr double kTolerance = 1e-5;

// By the multiplier rule activations are as the arms.
TEST(LeastActivation, OfSquaresIsInProportionToArms) {
  const VectorXd a = least_activation(shared_load(), TrackCost::Squares);
  EXPECT_NEAR(a[0], 0.2, kTolerance);
  EXPECT_NEAR(a[1], 0.4, kTolerance);
}

// Their squares are as the arms: b = sqrt(2) a.
TEST(LeastActivation, OfCubesGoesByTheRootsOfArms) {
  const VectorXd a = least_activation(shared_load(), TrackCost::Cubes);
  const double expected = 1 / (1 + 2 * std::sqrt(2.0));
  EXPECT_NEAR(a[0], expected, kTolerance);
  EXPECT_NEAR(a[1], std::sqrt(2.0) * expected, kTolerance);
}

TEST(LeastActivation, OfTheLargestIsTheSameForAll) {
  const VectorXd a = least_activation(shared_load(), TrackCost::Largest);
  EXPECT_NEAR(a[0], 1.0 / 3, 1e-3);  // squares decide among near equals
  EXPECT_NEAR(a[1], 1.0 / 3, 1e-3);
}

// One excitation for three muscles costs three times as much.
TEST(LeastActivation, CountsEachMuscle) {
  ActivationProblem problem = shared_load();
  problem.A = Eigen::RowVector2d(1, 1) * 1e3;
  problem.count = Eigen::Vector2d(3, 1);
  const VectorXd a = least_activation(problem, TrackCost::Squares);
  EXPECT_NEAR(a[0], 0.25, kTolerance);
  EXPECT_NEAR(a[1], 0.75, kTolerance);
  EXPECT_DOUBLE_EQ(cost_of(TrackCost::Squares, a, problem.count), 3 * a[0] * a[0] + a[1] * a[1]);
}

TEST(LeastActivation, StaysWithinBounds) {
  ActivationProblem problem = shared_load();
  problem.lowest = Eigen::Vector2d(0.5, 0);
  problem.highest = Eigen::Vector2d(1, 0.1);
  for (const TrackCost cost : {TrackCost::Squares, TrackCost::Cubes, TrackCost::Largest}) {
    const VectorXd a = least_activation(problem, cost);
    EXPECT_NEAR(a[0], 0.8, 1e-3);
    EXPECT_NEAR(a[1], 0.1, 1e-3);
  }
}

}  // namespace articular::tools::least_activation_test
