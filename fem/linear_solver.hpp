#pragma once

#include <memory>
#include <span>

#include "fem/block_matrix.hpp"
#include "fem/pressure_term.hpp"

namespace articular::fem {

enum class FactorStatus { Ready, NotPositiveDefinite };

struct SolveReport {
  int iterations = 0;            // 0 for a direct solver
  double relative_residual = 0;  // of the last residual known, |b - A x| / |b|
  bool converged = true;
};

/// What is added to the matrix of a linear system.
struct PressurePart {
  std::span<const PressureTerm> terms;
  /// A matrix near the one that the terms are added to, with fewer blocks, positive definite: for
  /// preconditioners. Without it they take that matrix itself.
  const BlockMatrix* plain = nullptr;
};

/// Solves A x = b for a symmetric positive definite A of 3x3 blocks (the lower half is read).
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Takes A's values; keeps what depends on its pattern as long as pattern_id() stays.
  [[nodiscard]] virtual FactorStatus prepare(const BlockMatrix& A) = 0;
  /// The same for A + Σ scale G C⁻¹ Gᵀ, which is positive definite (A alone need not be).
  /// @throws std::logic_error where a solver has no way to
  [[nodiscard]] virtual FactorStatus prepare_with_pressure(const BlockMatrix& A,
                                                           const PressurePart& part);
  /// @param x  start value on entry (used by iterative solvers), solution on exit
  [[nodiscard]] virtual SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) = 0;
};

/// CHOLMOD, supernodal, one thread.
std::unique_ptr<LinearSolver> make_cholesky();

/// Conjugate gradients with the inverses of the diagonal blocks as preconditioner.
/// @param tolerance  on |r| / |b|
std::unique_ptr<LinearSolver> make_conjugate_gradients(double tolerance, int max_iterations);

/// Conjugate gradients for A + Σ scale G C⁻¹ Gᵀ with that of PressurePart::plain in place of A as
/// preconditioner, through the factor of the quasi-definite matrix [plain G; Gᵀ −C/scale]: a dozen
/// iterations at any ν, and no block of G C⁻¹ Gᵀ is formed.
/// @param tolerance  on |r| / |b|
std::unique_ptr<LinearSolver> make_saddle_point_solver(double tolerance, int max_iterations);

}  // namespace articular::fem
