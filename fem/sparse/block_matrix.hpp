#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::fem {

/// A square sparse matrix of 3x3 blocks in compressed rows, structurally symmetric, both halves
/// stored. Its pattern is built once; values are added in a fixed order.
class BlockMatrix {
 public:
  BlockMatrix() = default;
  /// The pattern of all pairs within each stencil, and the diagonal.
  /// @param stencils  lists of block indices in [0, num_blocks), one after the other
  /// @param offsets   stencil k is stencils[offsets[k] .. offsets[k+1])
  BlockMatrix(int num_blocks, std::span<const int> stencils, std::span<const int> offsets);

  int num_blocks() const { return static_cast<int>(row_begin_.size()) - 1; }
  int num_nonzero_blocks() const { return static_cast<int>(column_.size()); }
  std::span<const int> row_begin() const { return row_begin_; }  // num_blocks + 1
  std::span<const int> column() const { return column_; }        // sorted within a row
  /// Slot of block (i, j), or -1 where the pattern has none.
  int slot(int i, int j) const;
  Eigen::Map<Mat3> block(int slot) {
    return Eigen::Map<Mat3>(values_.data() + std::ptrdiff_t{9} * slot);
  }
  Eigen::Map<const Mat3> block(int slot) const {
    return Eigen::Map<const Mat3>(values_.data() + std::ptrdiff_t{9} * slot);
  }
  /// 9 a slot, column-major.
  double* values() { return values_.data(); }
  void set_zero();
  /// y = A x
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// A hash of the pattern: equal for equal patterns, so that a pattern built anew with the same
  /// blocks still meets the analysis that a solver keeps.
  std::uint64_t pattern_id() const { return pattern_id_; }

 private:
  std::vector<int> row_begin_{0}, column_;
  std::vector<double> values_;  // 9 a block, column-major
  std::uint64_t pattern_id_ = 0;
};

}  // namespace articular::fem
