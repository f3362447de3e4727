#pragma once

#include "fem/linear_solver.hpp"
#include "sim/integrator.hpp"

namespace articular::sim {

/// The linear solves of Newton's iteration at the state that `dynamics` evaluated last.
class NewtonSystem {
 public:
  NewtonSystem(const Model& model, Dynamics& dynamics);

  /// Solves (I − γ ∂rate/∂y) x = b, reduced to block velocities.
  /// @return false when the matrix can't be made positive definite or the solver fails
  [[nodiscard]] bool solve(const double* y, double gamma, const double* b, double* x,
                           IntegratorCounts& counts);

 private:
  bool prepare(double gamma, IntegratorCounts& counts);

  const Model& model_;
  Dynamics& dynamics_;
  std::unique_ptr<fem::LinearSolver> solver_;
  Eigen::VectorXd velocity_rhs_, mass_rhs_, w_;
};

}  // namespace articular::sim
