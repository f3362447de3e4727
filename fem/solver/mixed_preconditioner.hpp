#pragma once

#include <Eigen/Core>

#include "fem/base/types.hpp"
#include "fem/solver/mixed_system.hpp"
#include "fem/solver/multigrid_preconditioner.hpp"
#include "fem/sparse/mirrored_matrix.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// An approximate inverse of a MixedSystem, lower block triangular [Elman, Silvester, Wathen 2014,
/// ch. 4]:
///
///   x = B r,   p = −T⁻¹ (q − σ Gᵀ x),
///
/// with a multigrid cycle B of a matrix near A, and the diagonal T of C/scale + α Gᵀ D⁻¹ G, D the
/// diagonal blocks of that matrix, in place of the Schur complement of A. A diagonal serves at any
/// ν: Gᵀ A⁻¹ G is near a mass matrix over μ, as is the stabilisation in C.
///
/// [Elman, Silvester, Wathen 2014] Finite Elements and Fast Iterative Solvers, 2nd ed. Oxford.
class MixedPreconditioner {
 public:
  /// A matrix near A.
  /// @return false where it is not finite, or a diagonal block is not positive definite
  [[nodiscard]] bool set_matrix(const BlockMatrix& near, ThreadPool& pool);
  /// After set_matrix(): a new cycle. @param x  positions of the nodes [m]
  [[nodiscard]] bool build(const Positions& x, ThreadPool& pool);
  /// After set_matrix(): the old cycle, turned with the nodes.
  void turn(const Positions& x, ThreadPool& pool) { multigrid_.turn(near_, x, pool); }
  /// After set_matrix(): T.
  void set_pressures(const MixedSystem& system);
  /// x = B r. @return r·x, positive where B is positive definite
  double displacements(const Eigen::VectorXd& r, bool use_cycle, Eigen::VectorXf& x,
                       ThreadPool& pool);
  /// p = −T⁻¹ (q − σ q_x), q_x = Gᵀ x
  void pressures(const Eigen::VectorXd& q, const Eigen::VectorXd& q_x, Eigen::VectorXf& p) const;
  void use_sure_bounds() { multigrid_.cycle().use_sure_bounds(); }
  /// Force by change of volume [N/m³]: makes rows of pressures comparable with those of blocks.
  const Eigen::VectorXd& row_scale() const { return row_scale_; }

 private:
  MirroredMatrix near_;
  MultigridPreconditioner multigrid_;
  bool has_pattern_ = false;  // of near_, has multigrid_
  Eigen::VectorXd T_, row_scale_, z_;
};

}  // namespace articular::fem
