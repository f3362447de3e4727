#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "fem/element/elasticity.hpp"
#include "tests/fem/support/box_mesh.hpp"

namespace articular::fem::lumped_mass_test {

constexpr double kDensity = 1060;  // [kg/m³] muscle

TEST(LumpedMass, SumsToTheMassOfTheBody) {
  const Vec3 size(0.02, 0.01, 0.005);
  const TetMesh mesh = box_mesh({4, 3, 2}, size, 0.15);
  const Eigen::VectorXd mass = lumped_mass(mesh.X, mesh.tets, kDensity);
  ASSERT_EQ(mass.size(), mesh.X.cols());
  EXPECT_GT(mass.minCoeff(), 0);
  EXPECT_NEAR(mass.sum(), kDensity * size.prod(), 1e-12 * kDensity * size.prod());
}

TEST(LumpedMass, IsAQuarterOfTheElementAtEachNode) {
  Positions X(3, 5);
  X << 0, 2, 0, 0, 7,  //
      0, 0, 3, 0, 7,   //
      0, 0, 0, 4, 7;   // node 4 belongs to no element
  const Eigen::VectorXd mass = lumped_mass(X, Tetrahedra(Eigen::Vector4i(0, 1, 2, 3)), kDensity);
  for (int a = 0; a < 4; ++a) EXPECT_NEAR(mass[a], kDensity, 1e-12 * kDensity);  // V = 4 m³
  EXPECT_EQ(mass[4], 0);
}

TEST(LumpedMass, RefusesBadInput) {
  TetMesh mesh = box_mesh({1, 1, 1}, Vec3(1, 1, 1));
  for (const double density : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(lumped_mass(mesh.X, mesh.tets, density), std::invalid_argument);
  }
  std::swap(mesh.tets(0, 2), mesh.tets(1, 2));
  EXPECT_THROW(lumped_mass(mesh.X, mesh.tets, kDensity), std::invalid_argument);
}

}  // namespace articular::fem::lumped_mass_test
