#pragma once

#include <memory>
#include <span>

#include "fem/base/types.hpp"
#include "fem/sparse/block_matrix.hpp"
#include "fem/sparse/pressure_term.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

enum class FactorStatus { Ready, NotPositiveDefinite };

struct SolveReport {
  int iterations = 0;            // 0 for a direct solver
  double relative_residual = 0;  // of the last residual known, |b - A x| / |b|
  bool converged = true;
  bool is_indefinite = false;  // an iteration met a direction in which A does not resist
  int repairs = 0;  // preconditioners that proved unfit during this solve and were replaced
};

/// What is added to the matrix of a linear system.
struct PressurePart {
  std::span<const PressureTerm> terms;
  /// A matrix near the one that the terms are added to, with fewer blocks, positive definite: for
  /// preconditioners. Without it they take that matrix itself. Multigrid takes half the iterations
  /// where this one resists changes of volume, too, like a material with ν = 0.3.
  const BlockMatrix* plain = nullptr;
};

/// Solves A x = b for a symmetric positive definite A of 3x3 blocks (the lower half is read).
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Takes A's values; keeps what depends on its pattern as long as pattern_id() stays.
  /// @param x  where the nodes are now [m]: those of the first blocks, further blocks are no nodes.
  ///           Multigrid lives on it; the others do without. Without nodes, nothing is known of
  ///           them.
  [[nodiscard]] virtual FactorStatus prepare(const BlockMatrix& A, const Positions& x) = 0;
  [[nodiscard]] FactorStatus prepare(const BlockMatrix& A) { return prepare(A, Positions(3, 0)); }
  /// The same for A + Σ scale G C⁻¹ Gᵀ, which is positive definite (A alone need not be).
  /// @throws std::logic_error where a solver has no way to
  [[nodiscard]] virtual FactorStatus prepare_with_pressure(const BlockMatrix& A, const Positions& x,
                                                           const PressurePart& part);
  [[nodiscard]] FactorStatus prepare_with_pressure(const BlockMatrix& A, const PressurePart& part) {
    return prepare_with_pressure(A, Positions(3, 0), part);
  }
  /// @param x  start value on entry (used by iterative solvers), solution on exit
  [[nodiscard]] virtual SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) = 0;
};

/// A supernodal factorization, see signed_cholesky.hpp.
/// @param pool  here and below: shared with others who compute at other times; the answer has the
///              same bits with any number of threads
std::unique_ptr<LinearSolver> make_cholesky(
    std::shared_ptr<ThreadPool> pool = std::make_shared<ThreadPool>(1));

/// Conjugate gradients with the inverses of the diagonal blocks as preconditioner.
/// @param tolerance  on |r| / |b|
std::unique_ptr<LinearSolver> make_conjugate_gradients(
    double tolerance, int max_iterations,
    std::shared_ptr<ThreadPool> pool = std::make_shared<ThreadPool>(1));

/// Conjugate gradients for A + Σ scale G C⁻¹ Gᵀ with that of PressurePart::plain in place of A as
/// preconditioner, through the factor of the quasi-definite matrix [plain G; Gᵀ −C/scale]: a dozen
/// iterations at any ν, and no block of G C⁻¹ Gᵀ is formed.
/// @param tolerance  on |r| / |b|
std::unique_ptr<LinearSolver> make_saddle_point_solver(
    double tolerance, int max_iterations,
    std::shared_ptr<ThreadPool> pool = std::make_shared<ThreadPool>(1));

/// Conjugate gradients with smoothed aggregation multigrid as preconditioner (multigrid.hpp): the
/// number of iterations hardly depends on the size of the mesh. While the pattern stays, so does
/// the preconditioner, turned with the nodes; it is built anew once the additional iterations that
/// its age has cost add up to the price of that. With the terms of a nodal pressure it is flexible
/// GMRES on the mixed system (mixed_multigrid.hpp), whose iterations do not depend on ν either.
/// @param tolerance  on |r| / |b|
std::unique_ptr<LinearSolver> make_multigrid(
    double tolerance, int max_iterations,
    std::shared_ptr<ThreadPool> pool = std::make_shared<ThreadPool>(1));

/// Another solver, started from the best combination of its last solutions in the energy norm
/// instead of the value given. Costs a product for each of them in prepare(), with a solution of C
/// where there is a nodal pressure; pays where one system
/// follows from the last, as step by step in time.
std::unique_ptr<LinearSolver> make_projected_start(std::unique_ptr<LinearSolver> solver,
                                                   int num_kept = 5);

}  // namespace articular::fem
