#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

/// The lower half of a symmetric matrix of 3x3 blocks in compressed rows, without blocks that are
/// zero: couplings of contacts that might close, or have opened, are. What goes over the matrix
/// again and again takes as long as reading it from memory.
struct LowerBlocks {
  std::vector<int> row_begin{0}, column;  // of the blocks below the diagonal; sorted within a row
  std::vector<Mat3> below;
  std::vector<Mat3> diagonal;  // symmetric

  int num_blocks() const { return static_cast<int>(diagonal.size()); }
  /// The lower half of A; A's blocks on the diagonal are mirrored as well.
  void take(const BlockMatrix& A);
  /// y = A x
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
};

}  // namespace articular::fem
