#include "fem/sparse/symmetric_matrix.hpp"

#include <cassert>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace articular::fem {

void SymmetricMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  assert(x.size() == size() && &x != &y);
  y.setZero(x.size());
  for (int j = 0; j < size(); ++j) {
    double sum = 0;
    for (int k = begin[j]; k < begin[j + 1]; ++k) {
      if (row[k] == j) {
        sum += value[k] * x[j];
      } else {
        sum += value[k] * x[row[k]];
        y[row[k]] += value[k] * x[j];
      }
    }
    y[j] += sum;
  }
}

void append_pattern(const BlockMatrix& A, SymmetricMatrix& to) {
  assert(to.size() == 0);
  const std::size_t num_entries = (9 * static_cast<std::size_t>(A.num_nonzero_blocks()) +
                                   3 * static_cast<std::size_t>(A.num_blocks())) /
                                  2;
  if (num_entries > std::numeric_limits<int>::max())
    throw std::length_error("the stiffness matrix has more than 2^31 - 1 entries");
  to.row.reserve(num_entries);
  for (int i = 0; i < A.num_blocks(); ++i) {
    for (int p = 0; p < 3; ++p) {
      for (int s = A.row_begin()[i]; A.column()[s] < i; ++s)
        for (int q = 0; q < 3; ++q) to.row.push_back(3 * A.column()[s] + q);
      for (int q = 0; q <= p; ++q) to.row.push_back(3 * i + q);
      to.end_column();
    }
  }
}

std::vector<int> groups_of_three(int num_blocks) {
  std::vector<int> group;
  group.reserve(3 * static_cast<std::size_t>(num_blocks));
  for (int i = 0; i < num_blocks; ++i) group.insert(group.end(), 3, i);
  return group;
}

double* copy_values(const BlockMatrix& A, double* to) {
  for (int i = 0; i < A.num_blocks(); ++i) {
    for (int p = 0; p < 3; ++p) {
      int s = A.row_begin()[i];
      for (; A.column()[s] < i; ++s) {
        const Eigen::Map<const Mat3> block = A.block(s);
        for (int q = 0; q < 3; ++q) *to++ = block(p, q);
      }
      for (int q = 0; q <= p; ++q) *to++ = A.block(s)(p, q);
    }
  }
  return to;
}

}  // namespace articular::fem
