#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <memory>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/solver/linear_solver.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::saddle_point_solver_test {

/// The stiffness of a free block, with `shift` of its first entry on the diagonal: its eigenvalues
/// are some thousandths of that and more, but for the six motions that only the shift resists.
BlockMatrix free_block(double shift, double E = 2e4) {
  const TetMesh mesh = box_mesh({4, 3, 3}, Vec3(0.02, 0.01, 0.01), 0.15);
  const Elasticity elasticity(mesh.X, mesh.tets, NeoHookean(E, 0.3));
  BlockMatrix K = elasticity.make_matrix();
  elasticity.add_stiffness(mesh.X, Tangent::Consistent, 1, K);
  const double on_diagonal = shift * K.block(0)(0, 0);
  for (int i = 0; i < K.num_blocks(); ++i) K.block(K.slot(i, i)) += on_diagonal * Mat3::Identity();
  return K;
}

struct Solution {
  SolveReport report;
  Eigen::VectorXd x;
};

Solution solve(const BlockMatrix& A, double tolerance, const Eigen::VectorXd& b) {
  const auto solver = make_saddle_point_solver(tolerance, 300);
  EXPECT_EQ(solver->prepare(A), FactorStatus::Ready);
  Solution solution;
  solution.report = solver->solve(b, solution.x);
  EXPECT_TRUE(solution.report.converged);
  return solution;
}

Eigen::VectorXd random_forces(const BlockMatrix& A) {
  return Random().matrix<Eigen::VectorXd>(3 * A.num_blocks(), 1);
}

// Each iteration with a factor in single precision gains 4 digits and more.
TEST(SaddlePointSolver, TakesFewIterationsToAnExactSolution) {
  const BlockMatrix A = free_block(0.1);
  const Eigen::VectorXd b = random_forces(A);
  const auto [report, x] = solve(A, 1e-13, b);
  const Eigen::VectorXd expected = dense(A).llt().solve(b);
  EXPECT_LT((x - expected).norm(), 1e-11 * expected.norm());
  EXPECT_LE(report.iterations, 3);
  EXPECT_EQ(report.repairs, 0);
}

// Numbers that single precision does not hold.
TEST(SaddlePointSolver, HasNoUnits) {
  const Eigen::VectorXd b = random_forces(free_block(0.1));
  const Eigen::VectorXd expected = solve(free_block(0.1), 1e-13, b).x;
  for (const double scale : {1e-60, 1e60}) {
    const auto [report, x] = solve(free_block(0.1, 2e4 * scale), 1e-13, scale * b);
    EXPECT_LT((x - expected).norm(), 1e-11 * expected.norm()) << scale;
    EXPECT_LE(report.iterations, 3);
  }
}

// What resists six motions is far below the round-off of single precision.
TEST(SaddlePointSolver, SolvesWhatSinglePrecisionCanNot) {
  const BlockMatrix A = free_block(1e-9);
  const Eigen::VectorXd b = random_forces(A);
  const Eigen::VectorXd x = solve(A, 1e-6, b).x;
  const Eigen::VectorXd expected = dense(A).llt().solve(b);
  EXPECT_LT((x - expected).norm(), 1e-3 * expected.norm());
}

TEST(SaddlePointSolver, TellsAFallingForceFromRoundOff) {
  for (const double shift : {-1e-9, -1e-2}) {
    const BlockMatrix A = free_block(shift);
    const auto solver = make_saddle_point_solver(1e-6, 300);
    EXPECT_EQ(solver->prepare(A), FactorStatus::NotPositiveDefinite) << shift;
  }
}

}  // namespace articular::fem::saddle_point_solver_test
