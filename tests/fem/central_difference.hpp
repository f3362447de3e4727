#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

namespace articular::fem {

/// Jacobian of `function` (vector in, vector out) at x by central differences of step h.
template <class Function>
Eigen::MatrixXd central_difference(const Function& function, const Eigen::VectorXd& x, double h) {
  Eigen::MatrixXd jacobian(function(x).size(), x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    Eigen::VectorXd above = x, below = x;
    above[k] += h;
    below[k] -= h;
    jacobian.col(k) = (function(above) - function(below)) / (above[k] - below[k]);
  }
  return jacobian;
}

/// The smallest relative distance of `jacobian` from central differences over a sweep of steps
/// around `scale`: large steps truncate, small ones cancel, and where they meet is not known
/// before.
template <class Function>
double derivative_error(const Function& function, const Eigen::VectorXd& x,
                        const Eigen::MatrixXd& jacobian, double scale) {
  double best = std::numeric_limits<double>::infinity();
  for (const double h : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const Eigen::MatrixXd difference = central_difference(function, x, h * scale) - jacobian;
    best = std::min(best, difference.norm() / jacobian.norm());
  }
  return best;
}

}  // namespace articular::fem
