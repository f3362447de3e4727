#include "tools/track/bounded_least_squares.hpp"

#include <Eigen/QR>
#include <optional>
#include <vector>

namespace articular::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

enum class Bound { Lowest, Free, Highest };

struct Problem {
  const MatrixXd& A;
  const VectorXd &b, &lowest, &highest;
};

/// The unknown at a bound beside which the sum falls most; none: it falls nowhere.
std::optional<Index> one_to_free(const Problem& p, const VectorXd& x,
                                 const std::vector<Bound>& bounds) {
  constexpr double kRoundOff = 1e-12;
  const VectorXd r = p.b - p.A * x, fall = p.A.transpose() * r;
  std::optional<Index> best;
  double most = 0;
  for (Index i = 0; i < x.size(); ++i) {
    const Bound bound = bounds[static_cast<std::size_t>(i)];
    if (bound == Bound::Free) continue;
    const double inward = bound == Bound::Lowest ? fall[i] : -fall[i];
    const bool counts = inward > kRoundOff * p.A.col(i).norm() * p.b.norm();
    if (!counts || inward <= most) continue;
    most = inward;
    best = i;
  }
  return best;
}

/// Least squares of the free unknowns, the others where they are.
VectorXd solved_for_free(const Problem& p, const VectorXd& x, const std::vector<Index>& free) {
  const VectorXd change =
      MatrixXd(p.A(Eigen::all, free)).colPivHouseholderQr().solve(p.b - p.A * x);
  VectorXd target = x;
  for (std::size_t k = 0; k < free.size(); ++k) target[free[k]] += change[static_cast<Index>(k)];
  return target;
}

/// Moves the free unknowns to where the sum is least, and those that get to a bound on the way stay
/// there.
void settle(const Problem& p, VectorXd& x, std::vector<Bound>& bounds) {
  for (;;) {
    std::vector<Index> free;
    for (Index i = 0; i < x.size(); ++i)
      if (bounds[static_cast<std::size_t>(i)] == Bound::Free) free.push_back(i);
    if (free.empty()) return;
    const VectorXd target = solved_for_free(p, x, free);
    double part = 1;
    Index first = -1;
    for (const Index i : free) {
      if (target[i] >= p.lowest[i] && target[i] <= p.highest[i]) continue;
      const double end = target[i] < p.lowest[i] ? p.lowest[i] : p.highest[i];
      const double way = (end - x[i]) / (target[i] - x[i]);
      if (first >= 0 && way >= part) continue;
      part = way;
      first = i;
    }
    x += part * (target - x);
    if (first < 0) return;
    const bool low = target[first] < p.lowest[first];
    x[first] = low ? p.lowest[first] : p.highest[first];
    bounds[static_cast<std::size_t>(first)] = low ? Bound::Lowest : Bound::Highest;
  }
}

}  // namespace

VectorXd bounded_least_squares(const MatrixXd& A, const VectorXd& b, const VectorXd& lowest,
                               const VectorXd& highest) {
  const Problem problem{A, b, lowest, highest};
  VectorXd x = lowest;
  std::vector<Bound> bounds(static_cast<std::size_t>(x.size()), Bound::Lowest);
  const Index most = 10 * x.size() + 10;  // round-off could go in circles
  for (Index k = 0; k < most; ++k) {
    const std::optional<Index> freed = one_to_free(problem, x, bounds);
    if (!freed) break;
    bounds[static_cast<std::size_t>(*freed)] = Bound::Free;
    settle(problem, x, bounds);
  }
  return x;
}

}  // namespace articular::tools
