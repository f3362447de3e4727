#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

/// Nonlinear least squares within bounds, of residuals some of which are limits.
namespace articular::tools {

/// Minimises half the sum of the squares of residuals r(x), limits where they are positive alone.
struct LeastSquaresProblem {
  Eigen::VectorXd start, lowest, highest;  // of the unknowns; infinite where there is no bound
  int residuals = 0;
  std::vector<bool> limits;  // of each residual: it counts only where it is positive; empty: none
  /// r(x), of limits what is left too (negative). False where there is none: the step is made
  /// shorter.
  std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& r)> evaluate;
  /// dr/dx, residuals x unknowns. False as above.
  std::function<bool(const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian)> differentiate;
  int most_iterations = 20;
  /// Ends where a step changes the sum of squares by less than this part of it, or the unknowns by
  /// less than this part of them.
  double tolerance = 1e-3;
};

struct LeastSquaresSolution {
  Eigen::VectorXd x;
  int iterations = 0;
  bool converged = false;
  std::string message;  // why it ended
};

/// By Marquardt's damped steps, damped as in [Nielsen. Damping parameter in Marquardt's method.
/// IMM-REP-1999-05]. A limit that holds at x has no slope there, and a step
/// that does not see it breaks it: so a step is the least of the model with limits and bounds in
/// it, sum of max(0, r_i + J_i d)^2 over limits and of (r_i + J_i d)^2 over the others, by Ceres
/// Solver. Exceptions of the functions are thrown on. Unknowns should be of the size of 1.
LeastSquaresSolution minimise(const LeastSquaresProblem& problem);

}  // namespace articular::tools
