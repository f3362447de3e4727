#pragma once

#include <memory>

#include "fem/block_matrix.hpp"

namespace articular::fem {

enum class FactorStatus { Ready, NotPositiveDefinite };

struct SolveReport {
  int iterations = 0;            // 0 for a direct solver
  double relative_residual = 0;  // of the last residual known, |b - A x| / |b|
  bool converged = true;
};

/// Solves A x = b for a symmetric positive definite A of 3x3 blocks (the lower half is read).
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Takes A's values; keeps what depends on its pattern as long as pattern_id() stays.
  [[nodiscard]] virtual FactorStatus prepare(const BlockMatrix& A) = 0;
  /// @param x  start value on entry (used by iterative solvers), solution on exit
  [[nodiscard]] virtual SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) = 0;
};

/// CHOLMOD, supernodal, one thread.
std::unique_ptr<LinearSolver> make_cholesky();

/// Conjugate gradients with the inverses of the diagonal blocks as preconditioner.
/// @param tolerance  on |r| / |b|
std::unique_ptr<LinearSolver> make_conjugate_gradients(double tolerance, int max_iterations);

}  // namespace articular::fem
