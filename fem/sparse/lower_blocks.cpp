#include "fem/sparse/lower_blocks.hpp"

namespace articular::fem {

void LowerBlocks::take(const BlockMatrix& A) {
  row_begin.assign(1, 0);
  column.clear();
  below.clear();
  diagonal.clear();
  for (int i = 0; i < A.num_blocks(); ++i) {
    int s = A.row_begin()[i];
    for (; A.column()[s] < i; ++s) {
      const Eigen::Map<const Mat3> block = A.block(s);
      if ((block.array() == 0).all()) continue;
      column.push_back(A.column()[s]);
      below.push_back(block);
    }
    diagonal.push_back(Mat3(A.block(s)).selfadjointView<Eigen::Lower>());
    row_begin.push_back(static_cast<int>(column.size()));
  }
}

void LowerBlocks::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  for (int i = 0; i < num_blocks(); ++i) {
    const Vec3 x_i = x.segment<3>(3 * Eigen::Index{i});
    Vec3 sum = diagonal[i] * x_i;
    for (int k = row_begin[i]; k < row_begin[i + 1]; ++k) {
      const Eigen::Index j = 3 * Eigen::Index{column[k]};
      sum += below[k] * x.segment<3>(j);
      y.segment<3>(j) += below[k].transpose() * x_i;
    }
    y.segment<3>(3 * Eigen::Index{i}) = sum;  // the first to write row i: later rows add to it
  }
}

}  // namespace articular::fem
