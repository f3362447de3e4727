#include "fem/solver/multigrid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <string>
#include <vector>

#include "fem/material/any_material.hpp"
#include "fem/solver/linear_solver.hpp"
#include "fem/solver/multigrid_preconditioner.hpp"
#include "tests/fem/support/clamped_box.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/hostile_systems.hpp"
#include "tests/fem/support/spectrum.hpp"

namespace articular::fem::multigrid_test {

constexpr double kTolerance = 1e-8;  // [-] on |r| / |b|
constexpr int kMostIterations = 500;
constexpr double kSingle = 1e-5;  // [-] rounding of single precision, in sums over a level

ClampedBox cube(int cells, double nu = 0.3) {
  return clamped_box(box_mesh({cells, cells, cells}, Vec3::Constant(0.1)), nu);
}

SolveReport solve(LinearSolver& solver, const ClampedBox& box, Eigen::VectorXd& x) {
  EXPECT_EQ(solver.prepare(box.K, box.X), FactorStatus::Ready);
  x.resize(0);
  return solver.solve(box.b, x);
}

TEST(Multigrid, AgreesWithCholesky) {
  const ClampedBox box = cube(8);
  Eigen::VectorXd x, expected;
  const auto multigrid = make_multigrid(1e-12, kMostIterations);
  EXPECT_TRUE(solve(*multigrid, box, x).converged);
  const auto cholesky = make_cholesky();
  EXPECT_TRUE(solve(*cholesky, box, expected).converged);
  EXPECT_LT((x - expected).norm(), 1e-8 * expected.norm());  // condition number 1e4
}

TEST(Multigrid, NeedsHardlyMoreIterationsOnAFinerMesh) {
  Eigen::VectorXd x;
  const int coarse = solve(*make_multigrid(kTolerance, kMostIterations), cube(8), x).iterations;
  const int fine = solve(*make_multigrid(kTolerance, kMostIterations), cube(16), x).iterations;
  EXPECT_LE(coarse, 20);
  EXPECT_LE(fine, 25);
}

class HostileTest : public testing::TestWithParam<int> {};

TEST_P(HostileTest, Converges) {
  const HostileSystem system = hostile_systems()[GetParam()];
  Eigen::VectorXd x;
  const SolveReport report = solve(*make_multigrid(kTolerance, kMostIterations), system.make(), x);
  EXPECT_TRUE(report.converged) << report.relative_residual;
  EXPECT_LE(report.iterations, system.most_iterations);
  EXPECT_EQ(report.repairs, 0);
}

// A cycle of a matrix that it could not solve with is no measure of what one should take.
TEST(Multigrid, KeepsNothingOfAMatrixThatItFailedWith) {
  Eigen::VectorXd x;
  const int fresh = solve(*make_multigrid(kTolerance, kMostIterations), cube(6), x).iterations;
  const auto solver = make_multigrid(kTolerance, fresh + 2);
  EXPECT_FALSE(solve(*solver, cube(6, 0.4999), x).converged);
  EXPECT_TRUE(solve(*solver, cube(6), x).converged);
}

INSTANTIATE_TEST_SUITE_P(Multigrid, HostileTest, testing::Range(0, 10));

class PreconditionerTest : public testing::Test {
 protected:
  void build(const ClampedBox& box) {
    A.take_pattern(box.K);
    ASSERT_TRUE(A.take_values(box.K, pool));
    ASSERT_TRUE(preconditioner.build(A, true, box.X, pool));
  }
  Eigen::VectorXd apply(const Eigen::VectorXd& r) {
    Eigen::VectorXd z(r.size());
    preconditioner.enter(0, A.num_rows(), r.data(), 1);
    preconditioner.apply_cycle(pool);
    preconditioner.leave(0, A.num_rows(), 1, z.data());
    return z;
  }

  ThreadPool pool{1};
  MirroredMatrix A;
  MultigridPreconditioner preconditioner;
};

TEST_F(PreconditionerTest, IsSymmetricAndPositive) {
  build(cube(10, 0.45));
  EXPECT_GE(preconditioner.cycle().num_levels(), 2);
  Random random;
  for (int k = 0; k < 5; ++k) {
    const auto x = random.matrix<Eigen::VectorXd>(3 * A.num_rows(), 1);
    const auto y = random.matrix<Eigen::VectorXd>(3 * A.num_rows(), 1);
    const Eigen::VectorXd Mx = apply(x), My = apply(y);
    EXPECT_GT(x.dot(Mx), 0);
    EXPECT_NEAR(x.dot(My), y.dot(Mx), kSingle * std::sqrt(x.dot(Mx) * y.dot(My)));
  }
}

TEST_F(PreconditionerTest, HasModestComplexity) {
  for (const HostileSystem& system : hostile_systems()) {
    build(system.make());
    EXPECT_LT(preconditioner.cycle().operator_complexity(), 6) << system.name;
  }
}

TEST_F(PreconditionerTest, BoundsTheLargestEigenvalue) {
  for (const ClampedBox& box :
       {cube(4), cube(4, 0.49), deformed_box({4, 4, 4}, 0.3, [](Vec3 x) { return x; })}) {
    build(box);
    const BlockRows<3>& S = preconditioner.cycle().matrix();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Identity(3 * S.num_rows(), 3 * S.num_rows());
    for (int i = 0; i < S.num_rows(); ++i) {
      for (int k = S.row_begin[i]; k < S.row_begin[i + 1]; ++k) {
        dense.block<3, 3>(3 * i, 3 * S.column[k]) =
            Eigen::Map<const Eigen::Matrix3f>(S.block(k)).cast<double>();
      }
    }
    const double largest = eigenvalues(dense).tail(1)[0];
    const LargestEigenvalue bound = largest_eigenvalue(S, pool);
    EXPECT_GE(bound.likely_bound, largest);
    EXPECT_LT(bound.likely_bound, 1.2 * largest);
    EXPECT_GE(bound.sure_bound, bound.likely_bound);
  }
}

/// A free body in the unknowns that multigrid has: A = L⁻¹ K L⁻ᵀ without its diagonal of ones.
struct FreeBody {
  TetMesh mesh = box_mesh({6, 5, 4}, Vec3(0.3, 0.2, 0.1), 0.15);
  std::vector<Mat3> factor;  // L of each node
  BlockRows<3> A;
  RigidModes modes;
  Aggregation aggregation;

  FreeBody() {
    const Elasticity elasticity(mesh.X, mesh.tets, Linear(1e6, 0.3));
    BlockMatrix K = elasticity.make_matrix();
    elasticity.add_stiffness(mesh.X, Tangent::Consistent, 1, K);
    const int n = K.num_blocks();
    factor.resize(n);
    for (int i = 0; i < n; ++i) {
      factor[i] = Eigen::LLT<Mat3>(K.block(K.slot(i, i))).matrixL();
      modes.center.push_back(mesh.X.col(i));
      Eigen::Matrix<double, 3, 6, Eigen::RowMajor> B = Eigen::Matrix<double, 3, 6>::Zero();
      B.leftCols<3>() = factor[i].transpose();
      modes.values.insert(modes.values.end(), B.data(), B.data() + 18);
    }
    for (int i = 0; i < n; ++i) {
      for (int s = K.row_begin()[i]; s < K.row_begin()[i + 1]; ++s) {
        const int j = K.column()[s];
        if (j == i) continue;
        const Mat3 half = factor[i].inverse() * K.block(s);
        const Eigen::Matrix3f scaled = (half * factor[j].transpose().inverse()).cast<float>();
        A.column.push_back(j);
        A.values.insert(A.values.end(), scaled.data(), scaled.data() + 9);
      }
      A.row_begin.push_back(static_cast<int>(A.column.size()));
    }
    A.values.resize(A.values.size() + kPadding);
    const std::vector<float> weight(A.column.size(), 1.0F);
    aggregation = aggregate({A.row_begin, A.column, weight}, 0.5F, {});
  }
};

/// A motion of the whole body, translation and rotation about the origin, given by the coarse modes
/// and prolongated.
void expect_rigid_motion(const FreeBody& body, const RigidModes& coarse, const Prolongation<3>& P,
                         ThreadPool& pool) {
  const Vec3 t(0.3, -0.2, 0.5), omega(2, 1, -3);
  std::vector<float> e = padded(6 * coarse.center.size()), u = padded(3 * body.factor.size());
  for (std::size_t a = 0; a < coarse.center.size(); ++a) {
    const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> R(coarse.values.data() +
                                                                           36 * a);
    Eigen::Matrix<double, 6, 1> motion;
    motion << t + omega.cross(coarse.center[a]), omega;
    Eigen::Map<Eigen::Matrix<float, 6, 1>>(e.data() + 6 * a) = (R * motion).cast<float>();
  }
  prolong(P, e, u, pool);
  for (std::size_t i = 0; i < body.factor.size(); ++i) {
    const Vec3 X = body.mesh.X.col(static_cast<Eigen::Index>(i));
    const Vec3 expected = body.factor[i].transpose() * (t + omega.cross(X));
    const Vec3 actual = Eigen::Map<const Eigen::Vector3f>(u.data() + 3 * i).cast<double>();
    EXPECT_LT((actual - expected).norm(), kSingle * (body.factor[i].norm() * t.norm()));
  }
}

// For a free body A B = 0, so that smoothing does not change the modes: P B_coarse = B everywhere.
// The coarse level's unknowns are scaled, and its modes with them.
TEST(Prolongation, ReproducesRigidMotions) {
  const FreeBody body;
  ThreadPool pool(1);
  ASSERT_GT(body.aggregation.num_aggregates, 1);
  Prolongation<3> P = prolongation_pattern(body.A, body.aggregation, {});
  RigidModes coarse =
      smoothed_prolongation(body.A, body.aggregation, {}, body.modes, 0.6F, P, pool);
  expect_rigid_motion(body, coarse, P, pool);

  BlockRows<6> coarse_A;
  const GalerkinPattern pattern = galerkin_pattern(body.A, P, coarse_A);
  (void)galerkin_product(body.A, pattern, P, coarse, coarse_A, pool);
  expect_rigid_motion(body, coarse, P, pool);
}

TEST(Multigrid, GivesTheSameBitsForAnyNumberOfThreads) {
  const ClampedBox box = cube(16);
  std::vector<Eigen::VectorXd> x(3);
  for (int threads = 1; threads <= 3; ++threads) {
    const auto solver =
        make_multigrid(kTolerance, kMostIterations, std::make_shared<ThreadPool>(threads));
    EXPECT_TRUE(solve(*solver, box, x[threads - 1]).converged);
    EXPECT_TRUE(solve(*solver, box, x[threads - 1]).converged);  // with its pattern known
  }
  EXPECT_EQ(x[0], x[1]);
  EXPECT_EQ(x[0], x[2]);
}

TEST(Multigrid, DoesWithoutNodes) {
  ClampedBox box = cube(10);
  Eigen::VectorXd x;
  const int with_nodes = solve(*make_multigrid(kTolerance, kMostIterations), box, x).iterations;
  box.X.resize(3, 0);
  const SolveReport report = solve(*make_multigrid(kTolerance, kMostIterations), box, x);
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.iterations, 4 * with_nodes);
}

// A body turned by a right angle: the old preconditioner, turned with it, is as good as new.
TEST(Multigrid, TurnsWithTheBody) {
  ClampedBox box = cube(10);
  const auto solver = make_multigrid(kTolerance, kMostIterations);
  Eigen::VectorXd x, turned;
  const int fresh = solve(*solver, box, x).iterations;
  const Mat3 R = Random().rotation();
  for (int s = 0; s < box.K.num_nonzero_blocks(); ++s) {
    box.K.block(s) = (R * box.K.block(s) * R.transpose()).eval();
  }
  box.X = (R * box.X).eval();
  box.b = (R * box.b.reshaped(3, box.X.cols())).reshaped().eval();
  const SolveReport report = solve(*solver, box, turned);
  EXPECT_LE(report.iterations, fresh + 1);
  EXPECT_EQ(report.repairs, 0);
  EXPECT_LT((turned.reshaped(3, box.X.cols()) - R * x.reshaped(3, box.X.cols())).norm(),
            1e-4 * x.norm());
}

TEST(Multigrid, ReplacesAPreconditionerThatIsTooOld) {
  ClampedBox box = cube(10);
  const auto solver = make_multigrid(kTolerance, kMostIterations);
  Eigen::VectorXd x;
  const int fresh = solve(*solver, box, x).iterations;
  for (int i = 0; i < box.K.num_blocks(); ++i) {  // other stiffness from node to node
    for (int s = box.K.row_begin()[i]; s < box.K.row_begin()[i + 1]; ++s) {
      const int j = box.K.column()[s];
      box.K.block(s) *= (i % 3 == 0 ? 30 : 1) * (j % 3 == 0 ? 30 : 1);
    }
  }
  const SolveReport report = solve(*solver, box, x);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.repairs, 1);
  EXPECT_LT(report.iterations, 5 * fresh + 20);
  EXPECT_LT(solve(*solver, box, x).iterations, 4 * fresh);
}

TEST(Multigrid, ReportsIndefiniteMatrices) {
  for (const double shift : {0.05, 0.3, 0.9}) {
    ClampedBox box = cube(10);
    for (int i = 0; i < box.K.num_blocks(); ++i) {
      const double first = box.K.block(box.K.slot(i, i))(0, 0);
      box.K.block(box.K.slot(i, i)) -= shift * first * Mat3::Identity();
    }
    const auto solver = make_multigrid(kTolerance, kMostIterations);
    if (solver->prepare(box.K, box.X) != FactorStatus::Ready) continue;
    Eigen::VectorXd x;
    EXPECT_FALSE(solver->solve(box.b, x).converged) << shift;
  }
}

TEST(Multigrid, ReportsNotANumberBesideTheDiagonalAndRecovers) {
  ClampedBox box = cube(8);
  const auto solver = make_multigrid(kTolerance, kMostIterations);
  const int slot = box.K.slot(200, box.K.column()[box.K.row_begin()[200]]);
  const double before = box.K.block(slot)(1, 2);
  box.K.block(slot)(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solver->prepare(box.K, box.X), FactorStatus::NotPositiveDefinite);
  box.K.block(slot)(1, 2) = before;
  Eigen::VectorXd x;
  EXPECT_TRUE(solve(*solver, box, x).converged);
  box.b[7] = std::numeric_limits<double>::infinity();
  x.resize(0);
  EXPECT_FALSE(solver->solve(box.b, x).converged);
}

TEST(Multigrid, RefusesBadSettings) {
  EXPECT_THROW(make_multigrid(0, 10), std::invalid_argument);
  EXPECT_THROW(make_multigrid(1e-6, 0), std::invalid_argument);
}

}  // namespace articular::fem::multigrid_test
