#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "fem/solver/linear_solver.hpp"
#include "tests/fem/support/hostile_systems.hpp"
#include "tests/fem/support/smoothed_box.hpp"

namespace articular::fem::multigrid_pressure_test {

constexpr double kTolerance = 1e-8;  // [-] on |r| / |b|
constexpr int kMostIterations = 1000;

TetMesh cube(int cells) { return box_mesh({cells, cells, cells}, Vec3::Constant(0.1)); }

SolveReport solve(LinearSolver& solver, SmoothedBox& box, Eigen::VectorXd& x) {
  EXPECT_EQ(solver.prepare_with_pressure(box.K, box.x, box.part()), FactorStatus::Ready);
  x.resize(0);
  return solver.solve(box.b, x);
}

int iterations(SmoothedBox box) {
  Eigen::VectorXd x;
  const SolveReport report = solve(*make_multigrid(kTolerance, kMostIterations), box, x);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.repairs, 0);
  return report.iterations;
}

/// |b − (A + Σ scale G C⁻¹ Gᵀ) x| / |b|
double condensed_residual(const BlockMatrix& A, const PressurePart& part, const Eigen::VectorXd& b,
                          const Eigen::VectorXd& x) {
  Eigen::VectorXd Ax;
  A.multiply(x, Ax);
  PressureOperator pressure;
  pressure.set(part.terms);
  pressure.add_product(x, Ax);
  return (b - Ax).norm() / b.norm();
}

TEST(MultigridWithPressure, AgreesWithTheSaddlePointSolver) {
  for (const double nu : {0.3, 0.4999}) {
    SmoothedBox box = smoothed_box(cube(6), nu);
    Eigen::VectorXd x, expected;
    const SolveReport report = solve(*make_multigrid(1e-11, kMostIterations), box, x);
    EXPECT_TRUE(report.converged);
    EXPECT_TRUE(solve(*make_saddle_point_solver(1e-11, 100), box, expected).converged);
    EXPECT_LT((x - expected).norm(), 1e-7 * expected.norm());  // condition number 1e4
    EXPECT_NEAR(report.relative_residual, condensed_residual(box.K, box.part(), box.b, x), 1e-12);
  }
}

TEST(MultigridWithPressure, NeedsAsManyIterationsForAnyBulkModulusAndMesh) {
  for (const int cells : {8, 12}) {
    for (const double nu : {0.3, 0.49, 0.499, 0.4999, 0.49999}) {
      EXPECT_LE(iterations(smoothed_box(cube(cells), nu)), 45) << cells << " cells, ν " << nu;
    }
  }
}

TEST(MultigridWithPressure, NeedsNoMoreWhereInertiaDominates) {
  for (const double inertia : {1.0, 1e2, 1e4, 1e6}) {
    for (const double nu : {0.3, 0.499, 0.49999}) {
      EXPECT_LE(iterations(smoothed_box(cube(8), nu, inertia)), 60)
          << "inertia " << inertia << ", ν " << nu;
    }
  }
}

TEST(MultigridWithPressure, DoesWithTheDistortionAlone) {
  for (const double nu : {0.3, 0.4999}) {
    EXPECT_LE(iterations(smoothed_box(cube(8), nu, 0, PlainPart::Distortion)), 70);
    SmoothedBox box = smoothed_box(cube(5), nu);
    Eigen::VectorXd x;
    const auto solver = make_multigrid(kTolerance, kMostIterations);
    ASSERT_EQ(solver->prepare_with_pressure(box.K, box.x, {.terms = box.part().terms}),
              FactorStatus::Ready);
    EXPECT_TRUE(solver->solve(box.b, x).converged);
  }
}

struct Hostile {
  const char* name;
  int most_iterations;  // measured plus about a third
  std::function<SmoothedBox()> make;
};

SmoothedBox deformed(double jitter, const std::function<Vec3(const Vec3&)>& map) {
  TetMesh mesh = box_mesh({12, 12, 12}, Vec3::Ones(), jitter);
  for (auto column : mesh.X.colwise()) column = map(column);
  return smoothed_box(mesh, 0.499);
}

void add_springs(const std::vector<Spring>& springs, int num_blocks, SmoothedBox& box) {
  box.K = with_springs(box.K, springs, num_blocks);
  box.plain = with_springs(box.plain, springs, num_blocks);
}

SmoothedBox box_with_springs(int num_springs) {
  SmoothedBox box = smoothed_box(box_mesh({12, 12, 12}, Vec3::Ones(), 0.2), 0.499);
  add_springs(random_contacts(box.K, num_springs), box.K.num_blocks(), box);
  return box;
}

/// Its face x = 1 fastened to two more blocks, translation and rotation of a bone, which have no
/// pressure.
SmoothedBox box_fastened_to_a_bone() {
  SmoothedBox box = smoothed_box(box_mesh({12, 12, 12}, Vec3::Ones(), 0.1), 0.499);
  const int n = box.K.num_blocks();
  std::vector<Spring> springs;
  for (int i = 0; i < n; ++i) {
    if (box.x(0, i) < 1 - 1e-9) continue;
    const Vec3 arm = box.x.col(i) - Vec3(1, 0.5, 0.5);
    for (int c = 0; c < 3; ++c) {
      const Vec3 axis = Vec3::Unit(c);
      springs.push_back({{i, n, n + 1}, {axis, -axis, -arm.cross(axis)}, 1e7});
    }
  }
  add_springs(springs, n + 2, box);
  const Tetrahedra &tets = box.elasticity->tets(),
                   &corners = box.elasticity->nodal_pressure().of_corner();
  std::vector<int> offsets;
  for (int e = 0; e <= tets.cols(); ++e) offsets.push_back(4 * e);
  PressureGradient G(n + 2, box.G.num_pressures(),
                     {tets.data(), static_cast<std::size_t>(tets.size())}, offsets,
                     {corners.data(), static_cast<std::size_t>(corners.size())}, offsets);
  for (int i = 0; i < n; ++i) {
    for (int s = box.G.row_begin()[i]; s < box.G.row_begin()[i + 1]; ++s) {
      G.block(G.slot(i, box.G.column()[s])) = box.G.block(s);
    }
  }
  box.G = G;
  box.b.conservativeResizeLike(Eigen::VectorXd::Constant(3 * (n + 2), 1e-3));
  return box;
}

std::vector<Hostile> hostile_boxes() {
  const auto same = [](const Vec3& x) { return x; };
  const auto flat = [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.1 * x.z()); };
  const auto graded = [](const Vec3& x) {
    return Vec3(x.x() * x.x() + 0.01 * x.x(), std::pow(x.y(), 3) + 0.01 * x.y(), x.z());
  };
  const auto slivers = [](const Vec3& x) {
    const int layer = static_cast<int>(std::lround(12 * x.z()));
    return Vec3(x.x(), x.y(), layer % 2 == 0 ? x.z() : x.z() - 0.95 / 12);
  };
  const auto uneven = [](double inside) {
    return smoothed_box(box_mesh({12, 12, 12}, Vec3::Ones()), 0.499, 0, PlainPart::Compressible,
                        inside);
  };
  return {
      {"Jittered", 48, [=] { return deformed(0.2, same); }},
      {"Flat", 160, [=] { return deformed(0, flat); }},
      {"Graded", 52, [=] { return deformed(0, graded); }},
      {"Slivers", 64, [=] { return deformed(0, slivers); }},
      {"SoftInclusion", 57, [=] { return uneven(1e-3); }},
      {"StiffInclusion", 53, [=] { return uneven(1e3); }},
      {"Contacts", 88, [] { return box_with_springs(200); }},
      {"Bone", 48, [] { return box_fastened_to_a_bone(); }},
  };
}

class HostilePressureTest : public testing::TestWithParam<int> {};

TEST_P(HostilePressureTest, Converges) {
  const Hostile system = hostile_boxes()[static_cast<std::size_t>(GetParam())];
  SmoothedBox box = system.make();
  Eigen::VectorXd x;
  const SolveReport report = solve(*make_multigrid(kTolerance, kMostIterations), box, x);
  EXPECT_TRUE(report.converged) << system.name << report.relative_residual;
  EXPECT_LE(report.iterations, system.most_iterations) << system.name;
  EXPECT_EQ(report.repairs, 0) << system.name;
}

INSTANTIATE_TEST_SUITE_P(MultigridWithPressure, HostilePressureTest, testing::Range(0, 8));

// The same pressure in two terms whose scales add up to one.
TEST(MultigridWithPressure, TakesSeveralTerms) {
  SmoothedBox box = smoothed_box(cube(5), 0.499);
  const PressurePart once = box.part();
  const std::vector<PressureTerm> halves{
      {.G = &box.G, .pressure = once.terms[0].pressure, .scale = 0.25},
      {.G = &box.G, .pressure = once.terms[0].pressure, .scale = 0.75}};
  const auto solver = make_multigrid(1e-10, kMostIterations);
  Eigen::VectorXd expected, x;
  EXPECT_TRUE(solve(*solver, box, expected).converged);
  ASSERT_EQ(solver->prepare_with_pressure(box.K, box.x, {.terms = halves, .plain = &box.plain}),
            FactorStatus::Ready);
  EXPECT_TRUE(solver->solve(box.b, x).converged);
  EXPECT_LT((x - expected).norm(), 1e-6 * expected.norm());
}

TEST(MultigridWithPressure, FollowsNewValuesOfOnePattern) {
  SmoothedBox box = smoothed_box(cube(6), 0.3);
  const auto solver = make_multigrid(kTolerance, kMostIterations);
  Eigen::VectorXd x;
  const int fresh = solve(*solver, box, x).iterations;
  EXPECT_LE(solve(*solver, box, x).iterations, fresh);
  for (const double nu : {0.4999, 0.3, 0.49}) {
    SmoothedBox other = smoothed_box(cube(6), nu, nu == 0.49 ? 1e3 : 0);
    const SolveReport report = solve(*solver, other, x);
    EXPECT_TRUE(report.converged);
    EXPECT_LT(condensed_residual(other.K, other.part(), other.b, x), 1.01 * kTolerance);
  }
  // Without pressure, and back.
  ASSERT_EQ(solver->prepare(box.plain, box.x), FactorStatus::Ready);
  EXPECT_TRUE(solver->solve(box.b, x).converged);
  EXPECT_TRUE(solve(*solver, box, x).converged);
}

TEST(MultigridWithPressure, GivesTheSameBitsForAnyNumberOfThreads) {
  SmoothedBox box = smoothed_box(cube(10), 0.499);
  std::vector<Eigen::VectorXd> x(3);
  for (int threads = 1; threads <= 3; ++threads) {
    const auto solver =
        make_multigrid(kTolerance, kMostIterations, std::make_shared<ThreadPool>(threads));
    EXPECT_TRUE(solve(*solver, box, x[static_cast<std::size_t>(threads) - 1]).converged);
  }
  EXPECT_EQ(x[0], x[1]);
  EXPECT_EQ(x[0], x[2]);
}

TEST(MultigridWithPressure, StartsFromTheValueGiven) {
  SmoothedBox box = smoothed_box(cube(6), 0.499);
  const auto solver = make_multigrid(kTolerance, kMostIterations);
  Eigen::VectorXd x;
  const int cold = solve(*solver, box, x).iterations;
  EXPECT_EQ(solver->solve(box.b, x).iterations, 0);
  x *= 1 + 1e-5;
  EXPECT_LT(solver->solve(box.b, x).iterations, cold);
}

TEST(MultigridWithPressure, StartsFromItsLastSolutions) {
  SmoothedBox box = smoothed_box(cube(6), 0.4999);
  const auto solver = make_projected_start(make_multigrid(kTolerance, kMostIterations), 2);
  Eigen::VectorXd x;
  const int cold = solve(*solver, box, x).iterations;
  const Eigen::VectorXd first = box.b;
  for (int i = 0; i < box.b.size(); i += 3) std::swap(box.b[i], box.b[i + 2]);
  EXPECT_GT(solve(*solver, box, x).iterations, cold / 2);
  box.b += 0.5 * first;
  EXPECT_LE(solve(*solver, box, x).iterations, cold / 4);
}

TEST(MultigridWithPressure, SaysWhereItGaveUp) {
  SmoothedBox box = smoothed_box(cube(6), 0.499);
  Eigen::VectorXd x;
  const SolveReport report = solve(*make_multigrid(kTolerance, 5), box, x);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 5);
  EXPECT_NEAR(report.relative_residual, condensed_residual(box.K, box.part(), box.b, x), 1e-12);
  EXPECT_LT(report.relative_residual, 1);
}

// Below round-off: the solver must notice and end.
TEST(MultigridWithPressure, EndsBelowRoundOff) {
  SmoothedBox box = smoothed_box(cube(5), 0.499);
  Eigen::VectorXd x;
  const SolveReport report = solve(*make_multigrid(1e-30, 100000), box, x);
  EXPECT_FALSE(report.converged);
  EXPECT_LT(report.iterations, 2000);
  EXPECT_LT(report.relative_residual, 1e-11);
}

TEST(MultigridWithPressure, ReportsIndefiniteAndBrokenMatrices) {
  SmoothedBox box = smoothed_box(cube(6), 0.499);
  const BlockMatrix K = box.K;
  const auto solver = make_multigrid(kTolerance, kMostIterations);
  Eigen::VectorXd x;
  for (int i = 0; i < K.num_blocks(); ++i) {
    box.K.block(K.slot(i, i)) -= 0.3 * K.block(K.slot(i, i))(0, 0) * Mat3::Identity();
  }
  EXPECT_FALSE(solve(*solver, box, x).converged);
  box.K.block(7)(1, 2) = std::numeric_limits<double>::quiet_NaN();
  box.K.block(box.K.slot(9, 9))(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solver->prepare_with_pressure(box.K, box.x, box.part()),
            FactorStatus::NotPositiveDefinite);
  box.K = K;
  EXPECT_TRUE(solve(*solver, box, x).converged);
}

/// Nodes get units of 1 to 10^6 m, or with −1 those that they had.
void change_units(double sign, SmoothedBox& box) {
  const auto unit = [&](int i) { return std::pow(10.0, sign * (i % 7)); };
  for (int i = 0; i < box.K.num_blocks(); ++i) {
    for (BlockMatrix* A : {&box.K, &box.plain}) {
      for (int s = A->row_begin()[i]; s < A->row_begin()[i + 1]; ++s) {
        A->block(s) *= unit(i) * unit(A->column()[s]);
      }
    }
    for (int s = box.G.row_begin()[i]; s < box.G.row_begin()[i + 1]; ++s) {
      box.G.block(s) *= unit(i);
    }
  }
}

// A cycle of a matrix that it could not solve with, or hardly, is no measure of what one should
// take: the next matrix gets its own.
TEST(MultigridWithPressure, KeepsNothingOfAMatrixThatItFailedWith) {
  SmoothedBox box = smoothed_box(cube(6), 0.499);
  const int fresh = iterations(smoothed_box(cube(6), 0.499));
  const auto solver = make_multigrid(kTolerance, fresh + 2);
  Eigen::VectorXd x;
  change_units(1, box);
  EXPECT_FALSE(solve(*solver, box, x).converged);
  change_units(-1, box);
  EXPECT_TRUE(solve(*solver, box, x).converged);
}

TEST(MultigridWithPressure, ReplacesACycleThatFillsTheSpaceOfDirections) {
  SmoothedBox box = smoothed_box(cube(6), 0.499);
  const int fresh = iterations(smoothed_box(cube(6), 0.499));
  const auto solver = make_multigrid(kTolerance, 5 * kMostIterations);
  Eigen::VectorXd x;
  change_units(1, box);
  EXPECT_GT(solve(*solver, box, x).iterations, 80);
  change_units(-1, box);
  const SolveReport easy = solve(*solver, box, x);
  EXPECT_TRUE(easy.converged);
  EXPECT_LE(easy.iterations, 82 + fresh);
}

}  // namespace articular::fem::multigrid_pressure_test
