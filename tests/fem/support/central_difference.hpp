#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <limits>

namespace articular::fem {

/// Vector in, vector out. Not a template: the many tests of derivatives compile once.
using VectorFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Jacobian of `function` at x by central differences of step h.
inline Eigen::MatrixXd central_difference(const VectorFunction& function, const Eigen::VectorXd& x,
                                          double h) {
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
inline double derivative_error(const VectorFunction& function, const Eigen::VectorXd& x,
                               const Eigen::MatrixXd& jacobian, double scale) {
  double best = std::numeric_limits<double>::infinity();
  for (const double h : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const Eigen::MatrixXd difference = central_difference(function, x, h * scale) - jacobian;
    best = std::min(best, difference.norm() / jacobian.norm());
  }
  return best;
}

}  // namespace articular::fem
