#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/sparse/block_matrix.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// The lower half of a symmetric matrix of 3x3 blocks in compressed rows, without blocks that are
/// zero: couplings of contacts that might close, or have opened, are. What goes over the matrix
/// again and again takes as long as reading it from memory.
///
/// Threads share it by pieces of rows, which depend on the matrix alone. A piece writes its own
/// rows of a product, and keeps what it adds to rows before them until all pieces are done.
class LowerBlocks {
 public:
  /// The lower half of A; A's blocks on the diagonal are mirrored as well.
  void take(const BlockMatrix& A);
  int num_blocks() const { return static_cast<int>(diagonal_.size()); }
  const std::vector<Mat3>& diagonal() const { return diagonal_; }
  /// Of the blocks below the diagonal; sorted within a row.
  const std::vector<int>& row_begin() const { return row_begin_; }
  const std::vector<int>& column() const { return column_; }
  /// y = A x
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y, ThreadPool& pool);

 private:
  struct Piece {
    int begin, end;            // rows
    std::vector<int> rows;     // before its own, that it adds to
    std::vector<Vec3> addend;  // to each of them
  };

  void divide();
  void multiply_piece(Piece& piece, const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

  std::vector<int> row_begin_{0}, column_;
  std::vector<int> place_;  // of a block of another piece's column, in `rows`; else not read
  std::vector<Mat3> below_;
  std::vector<Mat3> diagonal_;  // symmetric
  std::vector<Piece> pieces_;
};

}  // namespace articular::fem
