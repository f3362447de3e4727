#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "fem/solver/aggregation.hpp"
#include "fem/solver/chebyshev.hpp"
#include "fem/solver/galerkin.hpp"
#include "fem/solver/prolongation.hpp"
#include "fem/sparse/block_rows.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// A matrix with identities on its diagonal, and how to go one level coarser.
template <int N>
struct MultigridLevel {
  BlockRows<N> A;
  LargestEigenvalue largest;
  ChebyshevSmoother smoother;
  std::vector<int> reach;  // reach_of_pieces(A)
  LevelVectors vectors;
  std::vector<char> unsmoothed;  // rows that the prolongator keeps as they are; empty: none
  Aggregation aggregation;
  Prolongation<N> P;
  GalerkinPattern galerkin;
};

/// A V-cycle of smoothed aggregation [Vanek 1996] with Chebyshev smoothing, in single precision: a
/// symmetric positive definite approximation of A⁻¹. All levels have identities on their diagonals
/// (the caller scales the finest, galerkin_product() the others), so that block Jacobi costs
/// nothing.
class Multigrid {
 public:
  /// From a new pattern. The rows marked in `alone` (empty: none) become aggregates of their own.
  /// @param modes  of the blocks of A
  /// @return false where a level is not positive definite
  [[nodiscard]] bool set_up(BlockRows<3> A, RigidModes modes, std::vector<char> alone,
                            ThreadPool& pool);
  /// After new values in matrix(): same aggregates, new numbers.
  [[nodiscard]] bool refresh(RigidModes modes, ThreadPool& pool);

  BlockRows<3>& matrix() { return finest_.A; }
  std::vector<float>& residual() { return finest_.vectors.r; }  // 3 a block, padded
  const std::vector<float>& result() const { return finest_.vectors.x; }
  /// result = M⁻¹ residual, which is used up.
  void apply(ThreadPool& pool);
  /// result = residual: what is left of the preconditioner is the scaling by the caller.
  void apply_identity() { finest_.vectors.x = finest_.vectors.r; }
  /// From now on, eigenvalues are bounded for sure, at the price of a slower smoother.
  void use_sure_bounds();

  int num_levels() const;
  /// Entries of the matrices of all levels, relative to the finest.
  double operator_complexity() const;
  const MultigridLevel<3>& finest() const { return finest_; }

 private:
  bool build(RigidModes modes, bool new_pattern, ThreadPool& pool);
  bool factorize_last();
  void cycle(std::size_t level, ThreadPool& pool);

  MultigridLevel<3> finest_;
  std::vector<MultigridLevel<6>> coarse_;
  bool direct_ = false;  // the last level is solved by dense_
  Eigen::LLT<Eigen::MatrixXd> dense_;
  Eigen::VectorXd dense_x_;
};

}  // namespace articular::fem
