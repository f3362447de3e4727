#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

/// A symmetric matrix of numbers: the upper half in compressed columns, rows ascending in each.
struct SymmetricMatrix {
  std::vector<int> begin{0};  // size() + 1
  std::vector<int> row;       // ≤ its column
  std::vector<double> value;

  int size() const { return static_cast<int>(begin.size()) - 1; }
  void end_column() { begin.push_back(static_cast<int>(row.size())); }
  /// y = A x
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
};

/// Appends the columns of A to a pattern that is empty so far, without values.
/// @throws std::length_error  beyond 2³¹ − 1 entries
void append_pattern(const BlockMatrix& A, SymmetricMatrix& to);
/// The number of the block of each unknown.
std::vector<int> groups_of_three(int num_blocks);
/// The values of those columns, read from A's lower half. @return the end of what was written
double* copy_values(const BlockMatrix& A, double* to);

}  // namespace articular::fem
