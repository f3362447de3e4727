#include "fem/solver/incomplete_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem {
namespace {

constexpr double kSingle = 2e-5;  // [-] of numbers of order one after some products

LowerBlocks lower(const BlockMatrix& A) {
  LowerBlocks blocks;
  blocks.take(A);
  return blocks;
}

/// A ⊗ I of a scalar matrix, with blocks where it is not zero.
BlockMatrix blocks_of(const Eigen::MatrixXd& scalar) {
  std::vector<int> stencils, offsets{0};
  const int n = static_cast<int>(scalar.rows());
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      if (scalar(i, j) == 0) continue;
      stencils.insert(stencils.end(), {i, j});
      offsets.push_back(static_cast<int>(stencils.size()));
    }
  }
  BlockMatrix A(n, stencils, offsets);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (const int slot = A.slot(i, j); slot >= 0) A.block(slot) = scalar(i, j) * Mat3::Identity();
    }
  }
  return A;
}

/// L D Lᵀ, by the solutions with unit vectors.
Eigen::MatrixXd factored(IncompleteCholesky& factor, Eigen::Index size) {
  Eigen::MatrixXd inverse(size, size);
  Eigen::VectorXd z;
  for (Eigen::Index k = 0; k < size; ++k) {
    factor.solve(Eigen::VectorXd::Unit(size, k), z);
    inverse.col(k) = z;
  }
  return inverse.inverse();
}

BlockMatrix stiffness_with_mass(const std::array<int, 3>& cells) {
  const TetMesh mesh = box_mesh(cells, Vec3(0.02, 0.01, 0.005), 0.15);
  const Elasticity elasticity(mesh.X, mesh.tets, NeoHookean(2e4, 0.3));
  BlockMatrix K = elasticity.make_matrix();
  elasticity.add_stiffness(mesh.X, Tangent::Consistent, 1, K);
  const double mass = 0.1 * K.block(0)(0, 0);
  for (int i = 0; i < K.num_blocks(); ++i) K.block(K.slot(i, i)) += mass * Mat3::Identity();
  return K;
}

TEST(IncompleteCholesky, IsExactWithoutFill) {
  Random random;
  BlockMatrix A(5, std::vector<int>{0, 1, 1, 2, 2, 3, 3, 4}, std::vector<int>{0, 2, 4, 6, 8});
  for (int i = 0; i < 5; ++i) {
    A.block(A.slot(i, i)) = 6 * Mat3::Identity();
    if (i == 0) continue;
    A.block(A.slot(i, i - 1)) = random.matrix3();
    A.block(A.slot(i - 1, i)) = A.block(A.slot(i, i - 1)).transpose();
  }
  IncompleteCholesky factor;
  ASSERT_TRUE(factor.factorize(lower(A)));
  EXPECT_EQ(factor.shift(), 0);
  EXPECT_LT((factored(factor, 15) - dense(A)).norm(), kSingle * dense(A).norm());
}

// What defines the factor without fill: its product is A where A has blocks.
TEST(IncompleteCholesky, HasTheBlocksOfTheMatrix) {
  const BlockMatrix A = stiffness_with_mass({3, 2, 2});
  IncompleteCholesky factor;
  ASSERT_TRUE(factor.factorize(lower(A)));
  ASSERT_EQ(factor.shift(), 0);
  const Eigen::MatrixXd product = factored(factor, 3 * Eigen::Index{A.num_blocks()});
  const double scale = dense(A).cwiseAbs().maxCoeff();
  double elsewhere = 0;
  for (int i = 0; i < A.num_blocks(); ++i) {
    for (int j = 0; j < A.num_blocks(); ++j) {
      const Mat3 block = product.block<3, 3>(3 * Eigen::Index{i}, 3 * Eigen::Index{j});
      const int slot = A.slot(i, j);
      if (slot < 0) {
        elsewhere = std::max(elsewhere, block.cwiseAbs().maxCoeff());
      } else {
        EXPECT_LT((block - A.block(slot)).cwiseAbs().maxCoeff(), 1e-4 * scale);
      }
    }
  }
  EXPECT_GT(elsewhere, 1e-3 * scale);  // or there was no fill to leave out
}

// Kershaw's matrix: positive definite, its factor without fill has a negative pivot.
TEST(IncompleteCholesky, IsShiftedWhereItWouldNotBePositive) {
  Eigen::Matrix4d kershaw;
  kershaw << 3, -2, 0, 2, -2, 3, -2, 0, 0, -2, 3, -2, 2, 0, -2, 3;
  ASSERT_GT(kershaw.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
  IncompleteCholesky factor;
  ASSERT_TRUE(factor.factorize(lower(blocks_of(kershaw))));
  const double shift = factor.shift();
  EXPECT_GT(shift, 0);
  EXPECT_LE(shift, 0.25);
  const Eigen::MatrixXd product = factored(factor, 12);
  EXPECT_LT((product - product.transpose()).norm(), kSingle * product.norm());
  EXPECT_GT(product.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
  EXPECT_NEAR(product(0, 0), 3 * (1 + shift), 3 * kSingle);
  EXPECT_NEAR(product(3, 0), -2, 3 * kSingle);
  // The next matrix does not need it.
  for (int k = 0; k < 4; ++k) ASSERT_TRUE(factor.factorize(lower(stiffness_with_mass({2, 1, 1}))));
  EXPECT_EQ(factor.shift(), 0);
}

TEST(IncompleteCholesky, TakesForcesOfAnySize) {
  const BlockMatrix A = stiffness_with_mass({2, 2, 1});
  IncompleteCholesky factor;
  ASSERT_TRUE(factor.factorize(lower(A)));
  const Eigen::VectorXd r = Random().matrix<Eigen::VectorXd>(3 * A.num_blocks(), 1);
  Eigen::VectorXd z, scaled;
  factor.solve(r, z);
  for (const double size : {1e-200, 1e-30, 1e30, 1e200}) {
    factor.solve(size * r, scaled);
    EXPECT_LT((scaled / size - z).norm(), kSingle * z.norm());
  }
  factor.solve(0 * r, scaled);
  EXPECT_EQ(scaled, Eigen::VectorXd::Zero(r.size()));
}

TEST(IncompleteCholesky, RefusesWhatNoShiftMends) {
  Eigen::Matrix2d indefinite;
  indefinite << 1, 3, 3, 1;
  IncompleteCholesky factor;
  EXPECT_FALSE(factor.factorize(lower(blocks_of(indefinite))));
  indefinite(0, 1) = indefinite(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(factor.factorize(lower(blocks_of(indefinite))));
  EXPECT_TRUE(factor.factorize(lower(stiffness_with_mass({1, 1, 1}))));
}

}  // namespace
}  // namespace articular::fem
