#pragma once

#include <Eigen/Core>

#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

inline Eigen::MatrixXd dense(const BlockMatrix& A) {
  const Eigen::Index n = 3 * Eigen::Index{A.num_blocks()};
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < A.num_blocks(); ++i) {
    for (int s = A.row_begin()[i]; s < A.row_begin()[i + 1]; ++s) {
      result.block<3, 3>(3 * Eigen::Index{i}, 3 * Eigen::Index{A.column()[s]}) = A.block(s);
    }
  }
  return result;
}

}  // namespace articular::fem
