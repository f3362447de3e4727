#include "fem/sparse/symmetric_matrix.hpp"

#include <gtest/gtest.h>

#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::symmetric_matrix_test {

TEST(SymmetricMatrix, OfABlockMatrixMultipliesLikeIt) {
  const std::vector<int> stencils{0, 2, 3, 1, 3, 4}, offsets{0, 3, 6};
  BlockMatrix A(6, stencils, offsets);
  Random random;
  for (int i = 0; i < A.num_blocks(); ++i) {
    for (int j = 0; j <= i; ++j) {
      if (A.slot(i, j) < 0) continue;
      const Mat3 block = random.matrix3();
      A.block(A.slot(i, j)) = i == j ? Mat3(block + block.transpose()) : block;
      if (i != j) A.block(A.slot(j, i)) = block.transpose();
    }
  }
  SymmetricMatrix upper;
  append_pattern(A, upper);
  upper.value.resize(upper.row.size());
  EXPECT_EQ(copy_values(A, upper.value.data()), upper.value.data() + upper.value.size());
  for (int j = 0; j < upper.size(); ++j) {
    EXPECT_EQ(upper.row[upper.begin[j + 1] - 1], j);
    for (int k = upper.begin[j] + 1; k < upper.begin[j + 1]; ++k)
      EXPECT_LT(upper.row[k - 1], upper.row[k]);
  }
  const Eigen::VectorXd x = random.matrix<Eigen::VectorXd>(18, 1);
  Eigen::VectorXd expected, y;
  A.multiply(x, expected);
  upper.multiply(x, y);
  EXPECT_LT((y - expected).norm(), 1e-14 * expected.norm());
  EXPECT_EQ(groups_of_three(2), (std::vector<int>{0, 0, 0, 1, 1, 1}));
}

}  // namespace articular::fem::symmetric_matrix_test
