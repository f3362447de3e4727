#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "collision/mesh/surface.hpp"
#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/shapes.hpp"
#include "sim/model/mass_properties.hpp"

namespace articular::sim::mesh_simplify_test {

MeshData ball_surface() {
  MeshData ball = sphere_mesh({0.01, 0.0007, Vec3(0.1, -0.2, 0.3)});
  ball.triangles = collision::build_surface(ball.tets, static_cast<int>(ball.X.cols())).faces;
  ball.tets.resize(4, 0);
  return ball;
}

// Facets of h on a ball of radius R lose about (h/R)²/4 of its volume: 600 triangles, 2 %.
TEST(MeshSimplify, ABallKeepsItsPlaceAndVolumeWithATenthOfTheTriangles) {
  const MeshData fine = ball_surface();
  ASSERT_GT(fine.triangles.cols(), 6000);
  const MeshData coarse = simplified(fine, 600);
  EXPECT_NEAR(static_cast<double>(coarse.triangles.cols()), 600, 6);
  EXPECT_LT(coarse.X.cols(), fine.X.cols());
  const MassProperties before = solid_mass_properties(fine.X, fine.triangles, 1000);
  const MassProperties after = solid_mass_properties(coarse.X, coarse.triangles, 1000);
  EXPECT_NEAR(after.mass, before.mass, 0.02 * before.mass);
  EXPECT_LT((after.center - before.center).norm(), 1e-4);
  for (Eigen::Index i = 0; i < coarse.X.cols(); ++i)
    EXPECT_NEAR((coarse.X.col(i) - before.center).norm(), 0.01, 2e-4);
}

TEST(MeshSimplify, ASurfaceWithFewerTrianglesStaysAsItIs) {
  const MeshData fine = ball_surface();
  const MeshData same = simplified(fine, static_cast<int>(fine.triangles.cols()));
  EXPECT_EQ(same.X, fine.X);
  EXPECT_EQ(same.triangles, fine.triangles);
}

}  // namespace articular::sim::mesh_simplify_test
