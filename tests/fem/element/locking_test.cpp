#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/solver/linear_solver.hpp"
#include "tests/fem/support/newton.hpp"

// Problems on which plain linear tetrahedra lock, against converged results of quadratic tetrahedra
// and three-field hexahedra (FEBio 4.11). Neo-Hookean, μ = 80.1938, κ/2 (J − 1)².
namespace articular::fem::locking_test {

constexpr double kMu = 80.1938;

double kappa(double nu) { return 2 * kMu * (1 + nu) / (3 * (1 - 2 * nu)); }

std::unique_ptr<LinearSolver> saddle_point_solver() { return make_saddle_point_solver(1e-8, 300); }

struct Result {
  double displacement;
  NewtonReport report;
};

Result solve(const LoadedBody& body, const SmoothedElasticity& elasticity,
             std::unique_ptr<LinearSolver> solver = saddle_point_solver(),
             const NewtonSettings& settings = {}) {
  Positions x = body.mesh.X;
  const NewtonReport report = equilibrate(formulation_of(elasticity), body, *solver, x, settings);
  EXPECT_TRUE(report.converged);
  return {x(body.axis, body.probe) - body.mesh.X(body.axis, body.probe), report};
}

Result solve(const LoadedBody& body, double nu) {
  return solve(
      body, SmoothedElasticity(body.mesh.X, body.mesh.tets, MooneyRivlin<>(kMu / 2, 0, kappa(nu))));
}

// Plain tetrahedra: −23 to −69 % with these 384 elements.
TEST(Locking, CooksMembraneIsWithinSixPercentOnACoarseMesh) {
  EXPECT_NEAR(solve(cook_membrane(8), 0.3).displacement, 8.756, 0.06 * 8.756);
  EXPECT_NEAR(solve(cook_membrane(8), 0.4999).displacement, 6.911, 0.06 * 6.911);
}

// Plain tetrahedra: −93 % with these 384 elements.
TEST(Locking, CompressedBlockIsWithinSixPercentOnACoarseMesh) {
  EXPECT_NEAR(solve(block_compression(4), 0.499).displacement, -0.274, 0.06 * 0.274);
}

// With the pressure as an unknown the bulk modulus is not felt by Newton's method: the whole load
// in one step, with as many iterations and no step cut short.
TEST(Locking, NewtonIterationsDoNotGrowTowardsIncompressibility) {
  const NewtonReport moderate = solve(cook_membrane(8), 0.499).report;
  for (const double nu : {0.49999, 0.499999}) {
    const NewtonReport report = solve(cook_membrane(8), nu).report;
    EXPECT_LE(report.iterations, moderate.iterations + 1) << nu;
    EXPECT_EQ(report.cut_steps, 0) << nu;
  }
}

// Both ways end at the same state, where p = A⁻¹ b.
TEST(Locking, PressureAsAnUnknownDoesNotChangeTheResult) {
  const LoadedBody body = cook_membrane(4);
  const SmoothedElasticity elasticity(body.mesh.X, body.mesh.tets,
                                      MooneyRivlin<>(kMu / 2, 0, kappa(0.49)));
  const double mixed = solve(body, elasticity).displacement;
  const double displacement_alone =
      solve(body, elasticity, saddle_point_solver(), {.pressure_unknown = false}).displacement;
  EXPECT_NEAR(mixed, displacement_alone, 1e-7 * mixed);
}

TEST(Locking, BothLinearSolversGiveTheSameResult) {
  const LoadedBody body = cook_membrane(4);
  const SmoothedElasticity elasticity(body.mesh.X, body.mesh.tets,
                                      MooneyRivlin<>(kMu / 2, 0, kappa(0.499)));
  const double direct = solve(body, elasticity).displacement;
  const double iterative =
      solve(body, elasticity, make_conjugate_gradients(1e-8, 5000)).displacement;
  EXPECT_NEAR(direct, iterative, 1e-7 * direct);
}

// A soft layer bonded to a base a hundred times as stiff, under a local pressure, moves as the
// layer alone on a rigid base, but for the little that the base gives way. Domains and pressures in
// common would make it up to 36 % too stiff.
TEST(Locking, SoftLayerDoesNotFeelTheStiffnessOfItsBaseInItsOwnElements) {
  for (const double nu : {0.3, 0.49, 0.499}) {
    LoadedBody body = block_compression(4);
    std::vector<int> material;
    for (const auto& tet : body.mesh.tets.colwise()) {
      double z = 0;
      for (const int a : tet) z += body.mesh.X(2, a) / 4;
      material.push_back(z > 0.5 ? 0 : 1);
    }
    const MooneyRivlin<> soft(kMu / 2, 0, kappa(nu)), stiff(500 * kMu, 0, 1000 * kappa(nu));
    const double bonded =
        solve(body, SmoothedElasticity(body.mesh.X, body.mesh.tets, {soft, stiff}, material))
            .displacement;
    for (Eigen::Index a = 0; a < body.mesh.X.cols(); ++a) {
      if (body.mesh.X(2, a) < 0.5 + 1e-9) body.fixed.col(a).setConstant(true);
    }
    const double on_rigid_base =
        solve(body, SmoothedElasticity(body.mesh.X, body.mesh.tets, {soft, soft}, material))
            .displacement;
    EXPECT_LE(bonded, on_rigid_base) << nu;  // downward
    EXPECT_NEAR(bonded, on_rigid_base, 0.01 * std::abs(on_rigid_base)) << nu;
  }
}

}  // namespace articular::fem::locking_test
