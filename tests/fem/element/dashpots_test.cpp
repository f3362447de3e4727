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

TEST(Dashpots, TheirMatrixIsTheDerivativeOfTheirForce) {
  constexpr double kDamping = 30, kStiffness = 0.7, kStep = 1e-6;
  const TetMesh mesh = box_mesh({2, 1, 1}, Vec3(0.02, 0.03, 0.01), 0.1);
  BlockMatrix K = Elasticity(mesh.X, mesh.tets, Linear(1e4, 0.3)).make_matrix();
  const Dashpots dashpots(mesh.X, mesh.tets, KelvinVoigt(3, 7), K);
  Random random;
  const auto any = [&] { return random.matrix<Positions>(3, mesh.X.cols()); };
  const Positions x = mesh.X + 1e-3 * any(), v = any(), u = any(), w = any();
  const auto change = [&](const Positions& by_x, const Positions& by_v) -> Positions {
    Positions ahead = Positions::Zero(3, x.cols()), behind = ahead;
    dashpots.add_force(x + kStep * by_x, v + kStep * by_v, ahead);
    dashpots.add_force(x - kStep * by_x, v - kStep * by_v, behind);
    return (ahead - behind) / (2 * kStep);
  };
  const Positions none = Positions::Zero(3, x.cols());
  const auto dot = [](const Positions& a, const Positions& b) { return a.cwiseProduct(b).sum(); };
  const double by_v = dot(w, change(none, u));
  const double by_x = 0.5 * (dot(w, change(u, none)) + dot(u, change(w, none)));
  const double expected = kDamping * by_v + kStiffness * by_x;
  dashpots.add_tangent(x, v, kDamping, kStiffness, K);
  Eigen::VectorXd product;
  K.multiply(u.reshaped(), product);
  const double found = w.reshaped().dot(product);
  const double size = kDamping * std::abs(by_v) + kStiffness * std::abs(by_x);
  EXPECT_GT(kStiffness * std::abs(by_x), 1e-2 * size);  // both take part
  EXPECT_GT(kDamping * std::abs(by_v), 1e-2 * size);
  EXPECT_NEAR(found, expected, 1e-6 * size);
}

}  // namespace articular::fem::dashpots_test
