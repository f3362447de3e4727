#include "fem/sparse/lower_blocks.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem {
namespace {

TEST(LowerBlocks, MultiplyAsTheWholeMatrix) {
  Random random;
  BlockMatrix A(4, std::vector<int>{0, 1, 3, 1, 2}, std::vector<int>{0, 3, 5});
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j <= i; ++j) {
      const int slot = A.slot(i, j);
      if (slot < 0 || (i == 3 && j == 1)) continue;  // that one stays zero
      const Mat3 block = random.matrix3();
      A.block(slot) = i == j ? Mat3(block + block.transpose()) : block;
      A.block(A.slot(j, i)) = A.block(slot).transpose();
    }
  }
  LowerBlocks lower;
  lower.take(A);
  EXPECT_EQ(lower.num_blocks(), 4);
  EXPECT_EQ(lower.column, (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(lower.row_begin, (std::vector<int>{0, 0, 1, 2, 3}));
  const Eigen::VectorXd x = random.matrix<Eigen::VectorXd>(12, 1);
  Eigen::VectorXd y(12);
  lower.multiply(x, y);
  EXPECT_LT((y - dense(A) * x).norm(), 1e-14 * x.norm());
}

}  // namespace
}  // namespace articular::fem
