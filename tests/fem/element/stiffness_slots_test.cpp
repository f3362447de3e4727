#include "fem/element/stiffness_slots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/fem/support/basic_laws.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::stiffness_slots_test {

constexpr double kE = 2e4;  // [Pa]
constexpr double kNu = 0.4;
constexpr double kRoundOff = 1e-13;   // relative: the same terms, summed in another order
const Vec3 kSize(0.02, 0.01, 0.005);  // [m]

class StiffnessSlotsTest : public testing::TestWithParam<BasicLaw> {
 protected:
  static AnyMaterial material() { return GetParam().make(kE, kNu); }
};
INSTANTIATE_TEST_SUITE_P(All, StiffnessSlotsTest, testing::ValuesIn(basic_laws()), name_of_law);

Positions shaken(const TetMesh& mesh) {
  const double cell = (mesh.X.col(mesh.tets(1, 0)) - mesh.X.col(mesh.tets(0, 0))).norm();
  return mesh.X + 0.1 * cell * Random().matrix<Positions>(3, mesh.X.cols());
}

std::vector<int> shuffled(int count) {
  std::vector<int> result(static_cast<std::size_t>(count));
  std::iota(result.begin(), result.end(), 0);
  std::shuffle(result.begin(), result.end(), std::minstd_rand(3));
  return result;
}

/// Every fifth node is left out; the others have rows of any order behind 2 rows of somebody else.
std::vector<int> scattered_rows(int num_nodes) {
  std::vector<int> rows = shuffled(num_nodes);
  int next = 2;
  for (int& row : rows) row = row % 5 == 0 ? -1 : row;
  std::vector<int> order = shuffled(num_nodes);
  for (const int node : order) {
    int& row = rows[static_cast<std::size_t>(node)];
    if (row >= 0) row = next++;
  }
  return rows;
}

BlockMatrix matrix_of(const Tetrahedra& tets, const std::vector<int>& rows) {
  std::vector<int> stencils, offsets{0};
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    for (const int node : tets.col(e)) {
      const int row = rows[static_cast<std::size_t>(node)];
      if (row >= 0) stencils.push_back(row);
    }
    offsets.push_back(static_cast<int>(stencils.size()));
  }
  stencils.insert(stencils.end(), {0, 1, 2, 3});  // somebody else's
  offsets.push_back(static_cast<int>(stencils.size()));
  return {*std::max_element(rows.begin(), rows.end()) + 1, stencils, offsets};
}

TEST_P(StiffnessSlotsTest, BlocksGoToTheRowsOfTheirNodes) {
  const TetMesh mesh = box_mesh({4, 3, 5}, kSize, 0.15);
  const Elasticity elasticity(mesh.X, mesh.tets, material());
  const Positions x = shaken(mesh);
  BlockMatrix K = elasticity.make_matrix();
  elasticity.add_stiffness(x, Tangent::Consistent, 0.5, K);

  const std::vector<int> rows = scattered_rows(elasticity.num_nodes());
  BlockMatrix A = matrix_of(mesh.tets, rows);
  for (int s = 0; s < A.num_nonzero_blocks(); ++s) A.block(s).setOnes();
  const Eigen::MatrixXd before = dense(A);
  const StiffnessSlots slots = elasticity.slots_in(A, rows);
  elasticity.add_stiffness(x, Tangent::Consistent, 0.5, slots, A);
  Eigen::MatrixXd expected = before;
  for (int i = 0; i < K.num_blocks(); ++i) {
    for (int s = K.row_begin()[i]; s < K.row_begin()[i + 1]; ++s) {
      const int row = rows[i], column = rows[K.column()[s]];
      if (row >= 0 && column >= 0) expected.block<3, 3>(3 * row, 3 * column) += K.block(s);
    }
  }
  EXPECT_LT((dense(A) - expected).norm(), kRoundOff * expected.norm());
  EXPECT_LT((dense(A) - dense(A).transpose()).norm(), 1e-15 * expected.norm());  // both halves
}

TEST_P(StiffnessSlotsTest, ForceAndStiffnessAtOnceAreThoseOfTwoCalls) {
  const TetMesh mesh = box_mesh({4, 3, 5}, kSize, 0.15);
  const Elasticity elasticity(mesh.X, mesh.tets, material());
  const Positions x = shaken(mesh);
  const std::vector<int> rows = scattered_rows(elasticity.num_nodes());
  for (const Tangent tangent : {Tangent::Consistent, Tangent::Projected}) {
    BlockMatrix A = matrix_of(mesh.tets, rows), A_both = A;
    const StiffnessSlots slots = elasticity.slots_in(A, rows);
    Positions f = Positions::Ones(3, x.cols()), f_both = f;
    elasticity.add_internal_force(x, f);
    elasticity.add_stiffness(x, tangent, 0.5, slots, A);
    elasticity.add_force_and_stiffness(x, tangent, 0.5, slots, f_both, A_both);
    EXPECT_LT((f_both - f).norm(), kRoundOff * f.norm());
    EXPECT_LT((dense(A_both) - dense(A)).norm(), kRoundOff * dense(A).norm());
  }
}

// Large enough for several parts; nodes and elements in no order.
TEST_P(StiffnessSlotsTest, SameBitsForAnyNumberOfThreads) {
  TetMesh mesh = box_mesh({13, 12, 11}, kSize, 0.15);
  const std::vector<int> node = shuffled(static_cast<int>(mesh.X.cols()));
  const std::vector<int> element = shuffled(static_cast<int>(mesh.tets.cols()));
  const TetMesh ordered = mesh;
  for (int a = 0; a < ordered.X.cols(); ++a) mesh.X.col(node[a]) = ordered.X.col(a);
  for (int e = 0; e < ordered.tets.cols(); ++e) {
    for (int a = 0; a < 4; ++a) mesh.tets(a, element[e]) = node[ordered.tets(a, e)];
  }
  const Positions x = shaken(mesh);
  Positions f_of_one;
  BlockMatrix K_of_one;
  double W_of_one = 0;
  for (const int threads : {1, 2, 3, 4, 7}) {
    const Elasticity elasticity(mesh.X, mesh.tets, material(), {},
                                {.pool = std::make_shared<ThreadPool>(threads)});
    Positions f = Positions::Zero(3, x.cols());
    elasticity.add_internal_force(x, f);
    BlockMatrix K = elasticity.make_matrix();
    elasticity.add_stiffness(x, Tangent::Consistent, 1, K);
    const double W = elasticity.energy(x);
    if (threads == 1) {
      f_of_one = f;
      K_of_one = K;
      W_of_one = W;
      continue;
    }
    EXPECT_EQ(f, f_of_one) << threads;
    EXPECT_EQ(W, W_of_one) << threads;
    for (int s = 0; s < K.num_nonzero_blocks(); ++s) {
      ASSERT_EQ(Mat3(K.block(s)), Mat3(K_of_one.block(s))) << threads;
    }
  }
}

// The parts of a large mesh cover it: what it does is what its two halves do, each too small to be
// divided.
TEST_P(StiffnessSlotsTest, ALargeMeshIsTheSumOfItsPieces) {
  const TetMesh mesh = box_mesh({13, 12, 11}, kSize, 0.15);
  const Positions x = shaken(mesh);
  const Eigen::Index half = mesh.tets.cols() / 2;
  Positions f = Positions::Zero(3, x.cols()), f_pieces = f;
  const Elasticity whole(mesh.X, mesh.tets, material());
  BlockMatrix K = whole.make_matrix(), K_pieces = K;
  whole.add_internal_force(x, f);
  whole.add_stiffness(x, Tangent::Consistent, 1, K);
  std::vector<int> rows(static_cast<std::size_t>(x.cols()));
  std::iota(rows.begin(), rows.end(), 0);
  for (const Tetrahedra& tets :
       {Tetrahedra(mesh.tets.leftCols(half)), Tetrahedra(mesh.tets.rightCols(half))}) {
    const Elasticity piece(mesh.X, tets, material());
    piece.add_internal_force(x, f_pieces);
    piece.add_stiffness(x, Tangent::Consistent, 1, piece.slots_in(K, rows), K_pieces);
  }
  EXPECT_LT((f - f_pieces).norm(), kRoundOff * f.norm());
  double difference = 0, size = 0;
  for (int s = 0; s < K.num_nonzero_blocks(); ++s) {
    difference = std::max(difference, (K.block(s) - K_pieces.block(s)).norm());
    size = std::max(size, K.block(s).norm());
  }
  EXPECT_LT(difference, kRoundOff * size);
}

std::string refusal(const Elasticity& elasticity, const BlockMatrix& A,
                    const std::vector<int>& rows) {
  try {
    const StiffnessSlots slots = elasticity.slots_in(A, rows);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(StiffnessSlots, RefusesAMatrixWithoutAnElementsBlocks) {
  const TetMesh mesh = box_mesh({1, 1, 1}, kSize);
  const Elasticity elasticity(mesh.X, mesh.tets, Corotated(kE, kNu));
  std::vector<int> rows{0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(refusal(elasticity, elasticity.make_matrix(), rows), "");
  const BlockMatrix diagonal(8, {}, {});
  EXPECT_NE(refusal(elasticity, diagonal, rows).find("no block ("), std::string::npos);
  for (const int bad : {-2, 8}) {
    rows[3] = bad;
    EXPECT_NE(refusal(elasticity, elasticity.make_matrix(), rows).find("must be in [-1, 8)"),
              std::string::npos);
  }
}

}  // namespace articular::fem::stiffness_slots_test
