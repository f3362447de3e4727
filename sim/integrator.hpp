#pragma once

#include <memory>

#include "fem/linear_solver.hpp"
#include "sim/dynamics.hpp"

namespace articular::sim {

struct IntegratorCounts {
  std::int64_t steps = 0;   // that SUNDIALS took
  std::int64_t failed = 0;  // that it could not (Newton iteration did not converge)
  std::int64_t newton_iterations = 0;
  std::int64_t force_evaluations = 0;
  std::int64_t factorizations = 0;
  std::int64_t projected_tangents = 0;  // matrices that were not positive definite as they came
  std::int64_t linear_iterations = 0;
  double solve_seconds = 0;  // factorization and solution
};

/// One implicit step of SUNDIALS' ARKODE (DIRK at fixed step) on y' = rate(t, y). Each step starts
/// afresh from (t, y): nothing of the past enters but the last matrix and its pattern.
///
/// Newton's linear system is reduced to block velocities: with δx = b_x + γ δv for the kinematic
/// rows (rotations: δθ in place of quaternions) and w = δv + b_x/γ,
///   (M + γ D + γ² K) w = M (b_v + b_x/γ) + γ ∂f/∂a δa,   δx = γ w.
/// Gyroscopic and moment terms are left out of the matrix, never out of the residual.
class ImplicitIntegrator {
 public:
  ImplicitIntegrator(const Model& model, Dynamics& dynamics);
  ~ImplicitIntegrator();
  ImplicitIntegrator(const ImplicitIntegrator&) = delete;
  ImplicitIntegrator& operator=(const ImplicitIntegrator&) = delete;

  /// Advances y from t to t + h. @return false when Newton's iteration did not converge; y is as
  /// before
  [[nodiscard]] bool advance(Eigen::VectorXd& y, double t, double h);

  /// Drops the matrix of the last step.
  void forget();

  const IntegratorCounts& counts() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace articular::sim
