#include "fem/solver/linear_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::linear_solver_test {

constexpr double kTolerance = 1e-11;  // [-] on |r| / |b|
constexpr double kShift = 0.1;        // [-] of the first entry: makes the stiffness regular
// The error is at most the condition number, about 50 with this shift, times the residual.
constexpr double kAccuracy = 50 * kTolerance;

struct NamedSolver {
  const char* name;
  std::unique_ptr<LinearSolver> (*make)();
};

class LinearSolverTest : public testing::TestWithParam<NamedSolver> {
 protected:
  std::unique_ptr<LinearSolver> solver = GetParam().make();

  void expect_dense_solution(const BlockMatrix& A) {
    const Eigen::VectorXd b = Random().matrix<Eigen::VectorXd>(3 * A.num_blocks(), 1);
    const Eigen::VectorXd expected = dense(A).llt().solve(b);
    ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
    const SolveReport report = solver->solve(b, x);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.relative_residual, kTolerance);
    EXPECT_NEAR(report.relative_residual, (b - dense(A) * x).norm() / b.norm(), 1e-14);
    EXPECT_LT((x - expected).norm(), kAccuracy * expected.norm());
  }
};

INSTANTIATE_TEST_SUITE_P(
    All, LinearSolverTest,
    testing::Values(NamedSolver{"Cholesky", [] { return make_cholesky(); }},
                    NamedSolver{"ConjugateGradients",
                                [] { return make_conjugate_gradients(kTolerance, 1000); }},
                    NamedSolver{"Multigrid", [] { return make_multigrid(kTolerance, 1000); }},
                    NamedSolver{"ProjectedStart",
                                [] {
                                  return make_projected_start(
                                      make_conjugate_gradients(kTolerance, 1000));
                                }}),
    [](const testing::TestParamInfo<NamedSolver>& info) { return info.param.name; });

BlockMatrix shifted_stiffness(const std::array<int, 3>& cells, double E = 2e4) {
  const TetMesh mesh = box_mesh(cells, Vec3(0.02, 0.01, 0.005), 0.15);
  const Elasticity elasticity(mesh.X, mesh.tets, NeoHookean(E, 0.3));
  BlockMatrix K = elasticity.make_matrix();
  elasticity.add_stiffness(mesh.X, Tangent::Consistent, 1, K);
  const double shift = kShift * K.block(0)(0, 0);
  for (int i = 0; i < K.num_blocks(); ++i) K.block(K.slot(i, i)) += shift * Mat3::Identity();
  return K;
}

/// A with blocks, most of them zero, for all pairs.
BlockMatrix with_all_blocks(const BlockMatrix& A) {
  std::vector<int> all(A.num_blocks());
  std::iota(all.begin(), all.end(), 0);
  BlockMatrix wide(A.num_blocks(), all, std::vector<int>{0, A.num_blocks()});
  for (int i = 0; i < A.num_blocks(); ++i) {
    for (int s = A.row_begin()[i]; s < A.row_begin()[i + 1]; ++s)
      wide.block(wide.slot(i, A.column()[s])) = A.block(s);
  }
  return wide;
}

TEST_P(LinearSolverTest, AgreesWithADenseSolution) {
  expect_dense_solution(shifted_stiffness({3, 3, 2}));
}

TEST_P(LinearSolverTest, FollowsNewValuesOfOnePattern) {
  expect_dense_solution(shifted_stiffness({3, 3, 2}));
  expect_dense_solution(shifted_stiffness({3, 3, 2}, 5e5));
}

TEST_P(LinearSolverTest, FollowsANewPattern) {
  expect_dense_solution(shifted_stiffness({3, 3, 2}));
  expect_dense_solution(shifted_stiffness({2, 4, 3}));  // more blocks
  expect_dense_solution(shifted_stiffness({1, 1, 1}));  // fewer blocks
  // As many blocks in every row as before, in other columns.
  const std::vector<int> pairs{0, 2, 4};
  BlockMatrix A(4, std::vector<int>{0, 1, 2, 3}, pairs);
  BlockMatrix B(4, std::vector<int>{0, 2, 1, 3}, pairs);
  for (BlockMatrix* M : {&A, &B}) {
    for (int s = 0; s < M->num_nonzero_blocks(); ++s) M->block(s) = 0.1 * Mat3::Ones();
    for (int i = 0; i < 4; ++i) M->block(M->slot(i, i)) = 4 * Mat3::Identity();
  }
  expect_dense_solution(A);
  expect_dense_solution(B);
}

TEST_P(LinearSolverTest, SolvesForManyRightHandSides) {
  const BlockMatrix A = shifted_stiffness({2, 2, 2});
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  const Eigen::LLT<Eigen::MatrixXd> expected(dense(A));
  Random random;
  Eigen::VectorXd x;
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXd b = random.matrix<Eigen::VectorXd>(3 * A.num_blocks(), 1);
    EXPECT_TRUE(solver->solve(b, x).converged);
    EXPECT_LT((x - expected.solve(b)).norm(), kAccuracy * x.norm());
  }
  EXPECT_TRUE(solver->solve(Eigen::VectorXd::Zero(x.size()), x).converged);
  EXPECT_EQ(x.norm(), 0);
}

TEST_P(LinearSolverTest, KeepsTheValuesItWasGiven) {
  BlockMatrix A = shifted_stiffness({2, 2, 2});
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(3 * A.num_blocks());
  const Eigen::VectorXd expected = dense(A).llt().solve(b);
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  A.set_zero();
  Eigen::VectorXd x;
  EXPECT_TRUE(solver->solve(b, x).converged);
  EXPECT_LT((x - expected).norm(), kAccuracy * expected.norm());
}

TEST_P(LinearSolverTest, ReadsTheLowerHalfOnly) {
  BlockMatrix A = shifted_stiffness({2, 2, 2});
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(3 * A.num_blocks());
  const Eigen::VectorXd expected = dense(A).llt().solve(b);
  for (int i = 0; i < A.num_blocks(); ++i) {
    for (int s = A.row_begin()[i]; s < A.row_begin()[i + 1]; ++s) {
      if (A.column()[s] > i) A.block(s).setConstant(7e9);
      if (A.column()[s] == i) A.block(s).triangularView<Eigen::StrictlyUpper>().setConstant(7e9);
    }
  }
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  Eigen::VectorXd x;
  EXPECT_TRUE(solver->solve(b, x).converged);
  EXPECT_LT((x - expected).norm(), kAccuracy * expected.norm());
}

TEST_P(LinearSolverTest, ReportsANegativeDiagonalBlockAndRecovers) {
  BlockMatrix A = shifted_stiffness({2, 2, 2});
  A.block(A.slot(5, 5)) = -Mat3(A.block(A.slot(5, 5)));
  EXPECT_EQ(solver->prepare(A), FactorStatus::NotPositiveDefinite);
  expect_dense_solution(shifted_stiffness({2, 2, 2}));
}

TEST_P(LinearSolverTest, ReportsValuesThatAreNotNumbers) {
  BlockMatrix A = shifted_stiffness({2, 2, 2});
  A.block(A.slot(5, 5))(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solver->prepare(A), FactorStatus::NotPositiveDefinite);
}

TEST_P(LinearSolverTest, GivesTheSameBitsEveryTime) {
  const BlockMatrix A = shifted_stiffness({5, 5, 5});
  const Eigen::VectorXd b = Random().matrix<Eigen::VectorXd>(3 * A.num_blocks(), 1);
  const auto other = GetParam().make();
  Eigen::VectorXd x, y;
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  ASSERT_EQ(other->prepare(shifted_stiffness({2, 2, 2})), FactorStatus::Ready);
  ASSERT_EQ(other->prepare(A), FactorStatus::Ready);
  EXPECT_TRUE(solver->solve(b, x).converged);
  EXPECT_TRUE(other->solve(b, y).converged);
  EXPECT_EQ(x, y);
}

/// Every diagonal block is positive definite, the whole is not: −1 for opposite motions of 0 and 1.
BlockMatrix indefinite() {
  BlockMatrix A(2, std::vector<int>{0, 1}, std::vector<int>{0, 2});
  A.block(A.slot(0, 0)) = A.block(A.slot(1, 1)) = Mat3::Identity();
  A.block(A.slot(1, 0)) = A.block(A.slot(0, 1)) = 2 * Mat3::Identity();
  return A;
}

TEST(Cholesky, ReportsAnIndefiniteMatrix) {
  EXPECT_EQ(make_cholesky()->prepare(indefinite()), FactorStatus::NotPositiveDefinite);
}

TEST(Cholesky, IsDirect) {
  const BlockMatrix A = shifted_stiffness({3, 3, 3});
  const auto solver = make_cholesky();
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  Eigen::VectorXd x;
  const SolveReport report = solver->solve(Eigen::VectorXd::Ones(3 * A.num_blocks()), x);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_LT(report.relative_residual, 1e-13);
}

TEST(ConjugateGradients, StopAtAnIndefiniteMatrix) {
  const auto solver = make_conjugate_gradients(kTolerance, 100);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(6), x;
  b << 1, 1, 1, -1, -1, -1;
  ASSERT_EQ(solver->prepare(indefinite()), FactorStatus::Ready);
  EXPECT_FALSE(solver->solve(b, x).converged);
}

TEST(ConjugateGradients, StartFromTheValueGiven) {
  const BlockMatrix A = shifted_stiffness({3, 3, 3});
  const auto solver = make_conjugate_gradients(kTolerance, 1000);
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(3 * A.num_blocks());
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  Eigen::VectorXd x;
  const int cold = solver->solve(b, x).iterations;
  EXPECT_GT(cold, 10);
  EXPECT_EQ(solver->solve(b, x).iterations, 0);
  x *= 1 + 1e-6;
  EXPECT_LT(solver->solve(b, x).iterations, cold);
}

TEST(ConjugateGradients, SayWhereTheyGaveUp) {
  const BlockMatrix A = shifted_stiffness({3, 3, 3});
  const auto solver = make_conjugate_gradients(kTolerance, 5);
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(3 * A.num_blocks());
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  Eigen::VectorXd x;
  const SolveReport report = solver->solve(b, x);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 5);
  EXPECT_NEAR(report.relative_residual, (b - dense(A) * x).norm() / b.norm(), 1e-14);
}

// A tolerance below round-off can't be met: the solver must notice and end.
TEST(ConjugateGradients, EndBelowRoundOff) {
  const BlockMatrix A = shifted_stiffness({3, 3, 3});
  const auto solver = make_conjugate_gradients(1e-30, 1000000);
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(3 * A.num_blocks());
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  Eigen::VectorXd x;
  const SolveReport report = solver->solve(b, x);
  EXPECT_FALSE(report.converged);
  EXPECT_LT(report.iterations, 10000);
  EXPECT_LT(report.relative_residual, 1e-13);
}

TEST(ConjugateGradients, RefuseBadSettings) {
  EXPECT_THROW(make_conjugate_gradients(0, 10), std::invalid_argument);
  EXPECT_THROW(make_conjugate_gradients(1e-6, 0), std::invalid_argument);
}

TEST(ProjectedStart, FindsCombinationsOfItsLastSolutions) {
  BlockMatrix A = shifted_stiffness({3, 3, 3});
  const auto solver = make_projected_start(make_conjugate_gradients(kTolerance, 1000), 3);
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  Random random;
  const Eigen::MatrixXd B = random.matrix<Eigen::MatrixXd>(3 * A.num_blocks(), 4);
  Eigen::VectorXd x;
  for (int k = 0; k < 4; ++k) EXPECT_GT(solver->solve(B.col(k), x).iterations, 10);
  for (const double scale : {1.0, 7.0}) {  // the second time with another matrix
    for (int s = 0; s < A.num_nonzero_blocks(); ++s) A.block(s) *= scale;
    ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
    EXPECT_LE(solver->solve(B.col(1) - 2 * B.col(2) + B.col(3), x).iterations, 5);
  }
  EXPECT_GT(solver->solve(B.col(0), x).iterations, 10);  // forgotten
}

// Contact changes the pattern: what is kept are solutions, whatever the matrix.
TEST(ProjectedStart, KeepsItsSolutionsWithANewPattern) {
  BlockMatrix A = shifted_stiffness({3, 3, 3});
  const auto solver = make_projected_start(make_conjugate_gradients(kTolerance, 1000), 3);
  const Eigen::VectorXd b = Random().matrix<Eigen::VectorXd>(3 * A.num_blocks(), 1);
  Eigen::VectorXd x;
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  EXPECT_GT(solver->solve(b, x).iterations, 10);
  BlockMatrix wider = with_all_blocks(A);
  ASSERT_NE(wider.pattern_id(), A.pattern_id());
  ASSERT_EQ(solver->prepare(wider), FactorStatus::Ready);
  EXPECT_LE(solver->solve(b, x).iterations, 1);
  A = shifted_stiffness({2, 2, 2});  // another size: nothing to start from
  ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
  EXPECT_GT(solver->solve(b.head(3 * A.num_blocks()), x).iterations, 5);
}

/// Solves by a dense factor, and remembers where it was to start.
class Remembering final : public LinearSolver {
 public:
  explicit Remembering(Eigen::VectorXd& start) : start_(start) {}
  using LinearSolver::prepare;
  FactorStatus prepare(const BlockMatrix& A, const Positions&) override {
    factor_.compute(dense(A));
    return FactorStatus::Ready;
  }
  SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) override {
    start_ = x;
    x = factor_.solve(b);
    return {};
  }

 private:
  Eigen::VectorXd& start_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

// Iterations end by the residual. A start that is better in energy may have a larger one.
TEST(ProjectedStart, LeavesAStartThatIsFartherFromTheGoal) {
  Eigen::VectorXd start, x;
  const auto solver = make_projected_start(std::make_unique<Remembering>(start), 1);
  BlockMatrix A(2, std::vector<int>{0, 1}, std::vector<int>{0, 2});
  const auto solve = [&](double stiffness, const Vec3& b_0, const Vec3& b_1) {
    A.block(A.slot(0, 0)) = Mat3::Identity();
    A.block(A.slot(1, 1)) = stiffness * Mat3::Identity();
    ASSERT_EQ(solver->prepare(A), FactorStatus::Ready);
    Eigen::VectorXd b(6);
    b << b_0, b_1;
    EXPECT_TRUE(solver->solve(b, x).converged);
  };
  const Vec3 e = Vec3::UnitX();
  solve(100, e, 10 * e);  // x = (e, e/10)
  // Half of 11 times that is best in energy. The residual would be (5.5, -55), which was (11, 0).
  solve(100, 11 * e, 0 * e);
  EXPECT_EQ(start, Eigen::VectorXd::Zero(6));
  solve(1, 11 * e, e);  // now x = (11, 0) is kept
  EXPECT_NEAR(start[0], 11, 1e-12);
}

TEST(ProjectedStart, RefusesBadSettings) {
  EXPECT_THROW(make_projected_start(nullptr), std::invalid_argument);
  EXPECT_THROW(make_projected_start(make_cholesky(), 0), std::invalid_argument);
}

}  // namespace articular::fem::linear_solver_test
