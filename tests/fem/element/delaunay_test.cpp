// Tetrahedra that do not lock, on Delaunay's mesh of randomly moved nodes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/solver/linear_solver.hpp"
#include "tests/fem/support/delaunay_mesh.hpp"
#include "tests/fem/support/newton.hpp"

namespace articular::fem::delaunay_test {

double displacement(const LoadedBody& body, double nu) {
  constexpr double kMu = 80.1938;  // of the converged results, see locking_test.cpp
  const MooneyRivlin<> material(kMu / 2, 0, 2 * kMu * (1 + nu) / (3 * (1 - 2 * nu)));
  const SmoothedElasticity elasticity(body.mesh.X, body.mesh.tets, material);
  const auto solver = make_saddle_point_solver(1e-8, 1000);
  Positions x = body.mesh.X;
  EXPECT_TRUE(equilibrate(formulation_of(elasticity), body, *solver, x).converged);
  return x(body.axis, body.probe) - body.mesh.X(body.axis, body.probe);
}

TEST(DelaunayMesh, FillsItsShapeWithoutSliversAndHasNoNodeInACircumsphere) {
  const TetMesh mesh = delaunay_block_compression(4).mesh;
  const MeshQuality quality = quality_of(mesh);
  EXPECT_NEAR(quality.volume, 1, 1e-12);
  EXPECT_GT(quality.smallest_dihedral, 10);
  EXPECT_LT(quality.largest_dihedral, 160);
  EXPECT_LT(quality.deepest_intrusion, 1e-9);
  EXPECT_EQ(mesh.X.cols(), 125);
}

// The load is a dead pressure on a quarter of the top, whose border has to be of edges.
TEST(DelaunayMesh, CarriesTheWholeLoad) {
  EXPECT_NEAR(delaunay_block_compression(8).f_ext.row(2).sum(), -25, 1e-10);
  EXPECT_NEAR(delaunay_cook_membrane(16).f_ext.row(1).sum(), 300, 1e-9);
}

TEST(DelaunayMesh, SmoothedTetrahedraAreWithinTwoAndAHalfPercent) {
  EXPECT_NEAR(displacement(delaunay_cook_membrane(16), 0.3), 8.756, 0.025 * 8.756);
  EXPECT_NEAR(displacement(delaunay_cook_membrane(16), 0.499), 6.921, 0.025 * 6.921);
  EXPECT_NEAR(displacement(delaunay_block_compression(8), 0.499), -0.274, 0.025 * 0.274);
}

}  // namespace articular::fem::delaunay_test
