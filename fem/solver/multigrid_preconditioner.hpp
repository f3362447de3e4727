#pragma once

#include <vector>

#include "fem/base/types.hpp"
#include "fem/solver/multigrid.hpp"
#include "fem/sparse/mirrored_matrix.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// M⁻¹ = S C Sᵀ with a V-cycle C for the matrix L⁻¹ A L⁻ᵀ, where L Lᵀ are the diagonal blocks of A,
/// and S = R L⁻ᵀ, R the rotations of the nodes since C was built.
class MultigridPreconditioner {
 public:
  /// Everything, from a matrix and the positions of the nodes, the first blocks of A [m].
  /// @return false where A proves not to be positive definite
  [[nodiscard]] bool build(const MirroredMatrix& A, bool new_pattern, const Positions& x,
                           ThreadPool& pool);
  /// Turns with the nodes; nothing where there are none, or other ones than in build().
  void turn(const MirroredMatrix& A, const Positions& x, ThreadPool& pool);

  /// Rows [begin, end) of the V-cycle's argument, scale Sᵀ r.
  void enter(Eigen::Index begin, Eigen::Index end, const double* r, double scale);
  void apply_cycle(ThreadPool& pool) { cycle_.apply(pool); }
  /// Block Jacobi in place of the cycle.
  void apply_nothing();
  /// Rows [begin, end) of z = scale S (V-cycle).
  void leave(Eigen::Index begin, Eigen::Index end, double scale, double* z) const;

  Multigrid& cycle() { return cycle_; }

 private:
  BlockRows<3> scaled_matrix(const MirroredMatrix& A, ThreadPool& pool) const;
  RigidModes modes(const MirroredMatrix& A) const;

  Multigrid cycle_;
  std::vector<Mat3> inverse_factor_;  // L⁻ᵀ
  std::vector<Mat3> rotation_;        // one a node
  std::vector<Eigen::Matrix3f> S_;
  Positions X_;  // when the cycle was built
};

}  // namespace articular::fem
