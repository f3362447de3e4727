#include "tools/track/least_activation.hpp"

#include <algorithm>
#include <cmath>

#include "tools/track/bounded_least_squares.hpp"

namespace articular::tools {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The least |A a - b|^2 + sum of weight a^2.
VectorXd with_weights(const ActivationProblem& problem, const VectorXd& weight,
                      const VectorXd& highest) {
  const Index m = problem.A.rows(), n = problem.A.cols();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(m + n, n);
  A.topRows(m) = problem.A;
  A.bottomRows(n).diagonal() = weight.cwiseSqrt();
  VectorXd b = VectorXd::Zero(m + n);
  b.head(m) = problem.b;
  return bounded_least_squares(A, b, problem.lowest, highest);
}

VectorXd least_squares_of(const ActivationProblem& problem) {
  return with_weights(problem, problem.effort * problem.count, problem.highest);
}

/// With weights 3/2 a of the iteration before, whose squares have the slope of cubes.
VectorXd least_cubes_of(const ActivationProblem& problem) {
  constexpr int kIterations = 60;
  constexpr double kLeast = 1e-4;  // below, muscles are silent
  VectorXd a = least_squares_of(problem);
  for (int k = 0; k < kIterations; ++k) {
    const VectorXd weight = 1.5 * problem.effort * problem.count.cwiseProduct(a.cwiseMax(kLeast));
    // Half of the way: the whole goes to and fro.
    const VectorXd next = 0.5 * (a + with_weights(problem, weight, problem.highest));
    const bool settled = (next - a).lpNorm<Eigen::Infinity>() < 1e-7;
    a = next;
    if (settled) break;
  }
  return a;
}

/// The bound for all whose least sum, with what it costs itself, is least: convex in the bound.
VectorXd least_largest_of(const ActivationProblem& problem) {
  constexpr int kSections = 50;
  constexpr double kAmongEquals = 1e-4;  // of the effort: squares decide where the largest does not
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  const VectorXd weight = kAmongEquals * problem.effort * problem.count;
  const auto bounded = [&](double bound) {
    return with_weights(problem, weight, problem.highest.cwiseMin(bound));
  };
  const auto sum = [&](double bound) {
    const VectorXd a = bounded(bound);
    return (problem.A * a - problem.b).squaredNorm() + problem.effort * bound * bound +
           weight.dot(a.cwiseAbs2());
  };
  double low = problem.lowest.maxCoeff(), high = problem.highest.maxCoeff();
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = sum(a), at_b = sum(b);
  for (int k = 0; k < kSections; ++k) {
    if (at_a <= at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - golden * (high - low);
      at_a = sum(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + golden * (high - low);
      at_b = sum(b);
    }
  }
  return bounded(0.5 * (low + high));
}

}  // namespace

double cost_of(TrackCost cost, const VectorXd& a, const VectorXd& count) {
  switch (cost) {
    case TrackCost::Squares:
      return count.dot(a.cwiseAbs2());
    case TrackCost::Cubes:
      return count.dot(a.array().cube().matrix());
    case TrackCost::Largest:
      return a.size() > 0 ? std::pow(a.maxCoeff(), 2) : 0;
  }
  return 0;
}

VectorXd least_activation(const ActivationProblem& problem, TrackCost cost) {
  switch (cost) {
    case TrackCost::Squares:
      return least_squares_of(problem);
    case TrackCost::Cubes:
      return least_cubes_of(problem);
    case TrackCost::Largest:
      return least_largest_of(problem);
  }
  return problem.lowest;
}

}  // namespace articular::tools
