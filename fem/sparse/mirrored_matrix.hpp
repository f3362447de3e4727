#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fem/sparse/block_matrix.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// Rows of a piece that a thread takes at once.
inline constexpr int kRowsOfSums = 512;

/// A copy of a symmetric BlockMatrix that reads the lower half only and keeps both, so that threads
/// can share its rows.
class MirroredMatrix {
 public:
  bool has_pattern_of(const BlockMatrix& A) const {
    return num_rows() == A.num_blocks() && pattern_id_ == A.pattern_id();
  }
  void take_pattern(const BlockMatrix& A);
  /// @return false where a value is not finite
  [[nodiscard]] bool take_values(const BlockMatrix& A, ThreadPool& pool);

  int num_rows() const { return static_cast<int>(row_begin_.size()) - 1; }
  const std::vector<int>& row_begin() const { return row_begin_; }
  const std::vector<int>& column() const { return column_; }
  const double* block(int slot) const { return values_.data() + std::ptrdiff_t{9} * slot; }
  const double* diagonal(int i) const { return block(diagonal_[i]); }

  /// Rows [begin, end) of y = A x. @return their part of x·y
  double multiply_rows(Eigen::Index begin, Eigen::Index end, const double* x, double* y) const;

 private:
  std::uint64_t pattern_id_ = 0;
  std::vector<int> row_begin_{0}, column_;
  std::vector<int> source_;  // of each block on or below the diagonal itself, else its mirror image
  std::vector<int> diagonal_;
  std::vector<double> values_;  // column-major
};

}  // namespace articular::fem
