#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

/// Nonlinear least squares within bounds, by the trust region of Ceres Solver.
namespace articular::tools {

/// Minimises half the sum of the squares of residuals r(x).
struct LeastSquaresProblem {
  Eigen::VectorXd start, lowest, highest;  // of the unknowns; infinite where there is no bound
  int residuals = 0;
  /// r(x). False where there is none: the step is made shorter.
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

/// Unknowns that arrive at a bound are kept there while the sum would fall beyond it. Exceptions of
/// the functions end it and are thrown on. Unknowns should be of the size of 1.
LeastSquaresSolution minimise(const LeastSquaresProblem& problem);

}  // namespace articular::tools
