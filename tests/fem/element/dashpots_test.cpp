#include "fem/element/dashpots.hpp"

#include <gtest/gtest.h>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/material/viscosity.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::dashpots_test {

TEST(Dashpots, PowerIsTheirForceTimesTheVelocity) {
  const TetMesh mesh = box_mesh({2, 3, 2}, Vec3(0.02, 0.03, 0.01), 0.1);
  const BlockMatrix pattern = Elasticity(mesh.X, mesh.tets, Linear(1e4, 0.3)).make_matrix();
  const Dashpots dashpots(mesh.X, mesh.tets, KelvinVoigt(3, 7), pattern);
  Random random;
  const Positions x = mesh.X + 1e-3 * random.matrix<Positions>(3, mesh.X.cols());
  const auto v = random.matrix<Positions>(3, mesh.X.cols());
  Positions f = Positions::Zero(3, mesh.X.cols());
  dashpots.add_force(x, v, f);
  const double expected = f.cwiseProduct(v).sum();
  EXPECT_GT(expected, 0);
  EXPECT_NEAR(dashpots.power(x, v), expected, 1e-12 * expected);
}

}  // namespace articular::fem::dashpots_test
