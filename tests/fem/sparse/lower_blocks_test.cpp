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
  EXPECT_EQ(lower.column(), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(lower.row_begin(), (std::vector<int>{0, 0, 1, 2, 3}));
  const Eigen::VectorXd x = random.matrix<Eigen::VectorXd>(12, 1);
  Eigen::VectorXd y(12);
  ThreadPool pool(1);
  lower.multiply(x, y, pool);
  EXPECT_LT((y - dense(A) * x).norm(), 1e-14 * x.norm());
}

/// A chain. Some of its rows are coupled to one far before them as well, and some to one of the
/// first.
BlockMatrix random_chain(int size, Random& random) {
  std::vector<int> stencils, offsets{0};
  const auto couple = [&](int i, int j) {
    stencils.insert(stencils.end(), {i, j});
    offsets.push_back(static_cast<int>(stencils.size()));
  };
  for (int i = 1; i < size; ++i) {
    couple(i - 1, i);
    if (i % 9 == 0) couple(i * 7 / 10, i);
    if (i % 50 == 0) couple(i % 17, i);
  }
  BlockMatrix A(size, stencils, offsets);
  for (int i = 0; i < size; ++i) {
    for (int slot = A.row_begin()[i]; A.column()[slot] < i; ++slot) {
      A.block(slot) = random.matrix3();
      A.block(A.slot(A.column()[slot], i)) = A.block(slot).transpose();
    }
    A.block(A.slot(i, i)) = Mat3::Identity();
  }
  return A;
}

TEST(LowerBlocks, ManyPiecesMultiplyAsTheWholeMatrix) {
  Random random;
  const BlockMatrix A = random_chain(5000, random);
  LowerBlocks lower;
  lower.take(A);
  const Eigen::VectorXd x = random.matrix<Eigen::VectorXd>(15000, 1);
  Eigen::VectorXd expected, y(15000), again(15000);
  A.multiply(x, expected);
  ThreadPool one(1), three(3);
  lower.multiply(x, y, one);
  EXPECT_LT((y - expected).norm(), 1e-14 * expected.norm());
  for (int i = 0; i < 20; ++i) {
    again.setRandom();
    lower.multiply(x, again, three);
    EXPECT_EQ(again, y);
  }
}

}  // namespace
}  // namespace articular::fem
