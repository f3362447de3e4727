#include "fem/sparse/block_matrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <set>
#include <utility>
#include <vector>

#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::block_matrix_test {

// Stencils of unlike sizes, one of them empty, one with a block twice; block 6 is in none.
const std::vector<int> kStencils{0, 3, 1, /**/ 5, 3, /**/ 2, 2, 4, /**/ 4, 5};
const std::vector<int> kOffsets{0, 3, 5, 5, 8, 10};

TEST(BlockMatrix, PatternIsEveryPairWithinAStencilAndTheDiagonal) {
  std::set<std::pair<int, int>> expected;
  for (int i = 0; i < 7; ++i) expected.emplace(i, i);
  for (std::size_t k = 0; k + 1 < kOffsets.size(); ++k) {
    for (int s = kOffsets[k]; s < kOffsets[k + 1]; ++s) {
      for (int t = kOffsets[k]; t < kOffsets[k + 1]; ++t) {
        expected.emplace(kStencils[s], kStencils[t]);
      }
    }
  }
  const BlockMatrix A(7, kStencils, kOffsets);
  ASSERT_EQ(A.num_blocks(), 7);
  std::vector<std::pair<int, int>> pattern;  // rows in order, columns sorted: the order of a set
  for (int i = 0; i < 7; ++i) {
    for (int s = A.row_begin()[i]; s < A.row_begin()[i + 1]; ++s) {
      pattern.emplace_back(i, A.column()[s]);
      EXPECT_EQ(A.slot(i, A.column()[s]), s);
    }
  }
  EXPECT_EQ(pattern, std::vector(expected.begin(), expected.end()));
  EXPECT_EQ(A.slot(0, 2), -1);
  EXPECT_EQ(A.slot(6, 5), -1);
  EXPECT_EQ(A.num_nonzero_blocks(), static_cast<int>(expected.size()));
}

TEST(BlockMatrix, StartsAtZeroAndReturnsToIt) {
  BlockMatrix A(7, kStencils, kOffsets);
  EXPECT_EQ(dense(A).norm(), 0);
  A.block(A.slot(3, 5)).setOnes();
  EXPECT_EQ(dense(A).norm(), 3);
  A.set_zero();
  EXPECT_EQ(dense(A).norm(), 0);
}

TEST(BlockMatrix, MultipliesAsTheDenseMatrixDoes) {
  Random random;
  BlockMatrix A(7, kStencils, kOffsets);
  for (int s = 0; s < A.num_nonzero_blocks(); ++s) A.block(s) = random.matrix3();
  const Eigen::VectorXd x = random.matrix<Eigen::VectorXd>(21, 1);
  Eigen::VectorXd y;
  A.multiply(x, y);
  const Eigen::VectorXd expected = dense(A) * x;
  EXPECT_LT((y - expected).norm(), 1e-14 * expected.norm());
}

TEST(BlockMatrix, PatternIdsAreEqualForEqualPatternsOnly) {
  const BlockMatrix A(7, kStencils, kOffsets);
  BlockMatrix copy = A;
  copy.block(0).setOnes();
  EXPECT_EQ(copy.pattern_id(), A.pattern_id());
  EXPECT_EQ(BlockMatrix(7, kStencils, kOffsets).pattern_id(), A.pattern_id());
  EXPECT_NE(BlockMatrix(8, kStencils, kOffsets).pattern_id(), A.pattern_id());
  std::vector<int> stencils = kStencils;
  stencils.back() = 6;
  EXPECT_NE(BlockMatrix(7, stencils, kOffsets).pattern_id(), A.pattern_id());
  EXPECT_NE(BlockMatrix().pattern_id(), A.pattern_id());
  // Two blocks in each row, in other columns.
  const std::vector<int> pairs{0, 2, 4};
  EXPECT_NE(BlockMatrix(4, std::vector<int>{0, 1, 2, 3}, pairs).pattern_id(),
            BlockMatrix(4, std::vector<int>{0, 2, 1, 3}, pairs).pattern_id());
}

TEST(BlockMatrix, MayBeEmpty) {
  EXPECT_EQ(BlockMatrix().num_blocks(), 0);
  EXPECT_EQ(BlockMatrix(0, {}, {}).num_blocks(), 0);
  EXPECT_EQ(BlockMatrix(3, {}, {}).num_nonzero_blocks(), 3);
}

}  // namespace articular::fem::block_matrix_test
