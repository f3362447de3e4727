#pragma once

#include "fem/linear_solver.hpp"
#include "sim/integrator.hpp"

namespace articular::sim {

/// The linear solves of Newton's iteration at the state that `dynamics` evaluated last. A matrix is
/// kept from one iteration, and from one step, to the next as long as the residual falls fast with
/// it.
class NewtonSystem {
 public:
  NewtonSystem(const Model& model, Dynamics& dynamics);

  /// A new step begins; with `keep_matrix` the last one's matrix may serve its first iteration.
  /// @param tangent  Projected: does without the consistent one
  void begin_step(bool keep_matrix, fem::Tangent tangent);

  /// Solves (I − γ ∂rate/∂y) x = b, reduced to block velocities.
  /// @return false when the matrix can't be made positive definite or the solver fails
  [[nodiscard]] bool solve(const double* y, double gamma, const double* b, double* x,
                           IntegratorCounts& counts);

 private:
  bool needs_matrix(double gamma) const;
  /// Part of the correction w that stays within Dynamics::trusted_motion().
  double step_fraction(double gamma) const;
  [[nodiscard]] bool prepare(double gamma, fem::Tangent tangent, IntegratorCounts& counts);
  [[nodiscard]] bool solve_linear(IntegratorCounts& counts);
  /// w, with the consistent matrix if it is positive definite, else with the projected one.
  [[nodiscard]] bool find_correction(double gamma, IntegratorCounts& counts);

  const Model& model_;
  Dynamics& dynamics_;
  std::unique_ptr<fem::LinearSolver> solver_;
  Eigen::VectorXd velocity_rhs_, mass_rhs_, shift_, pull_, w_;
  double gamma_ = 0;                                 // of the matrix that is factored; 0: none
  std::uint64_t pattern_ = 0;                        // of that matrix
  fem::Tangent tangent_ = fem::Tangent::Consistent;  // of that matrix
  fem::Tangent first_ = fem::Tangent::Consistent;    // to try in this step
  int iteration_ = 0;                                // in this step
  double residual_ = 0, last_residual_ = 0;          // of this iteration and the one before
};

}  // namespace articular::sim
