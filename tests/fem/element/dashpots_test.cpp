#include "fem/element/dashpots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fem/element/elasticity.hpp"
#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/material/viscosity.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::dashpots_test {

SmoothedElasticity smoothed_elements(const TetMesh& mesh) {
  return {mesh.X, mesh.tets, AnyMaterial{NeoHookean(1e4, 0.4)}};
}

/// Calls use(dashpots, a matrix for them) for those of plain and of smoothed elements.
void for_plain_and_smoothed(const TetMesh& mesh, const KelvinVoigt& law,
                            const std::function<void(const Dashpots&, BlockMatrix)>& use) {
  const BlockMatrix matrix = Elasticity(mesh.X, mesh.tets, Linear(1e4, 0.3)).make_matrix();
  use({mesh.X, mesh.tets, law, matrix}, matrix);
  const SmoothedElasticity smoothed = smoothed_elements(mesh);
  use({smoothed, law}, smoothed.make_matrix());
}

double dot(const Positions& a, const Positions& b) { return a.cwiseProduct(b).sum(); }

TEST(Dashpots, PowerIsTheirForceTimesTheVelocity) {
  const TetMesh mesh = box_mesh({2, 3, 2}, Vec3(0.02, 0.03, 0.01), 0.1);
  for_plain_and_smoothed(mesh, {3, 7}, [&](const Dashpots& dashpots, const BlockMatrix&) {
    Random random;
    const Positions x = mesh.X + 1e-3 * random.matrix<Positions>(3, mesh.X.cols());
    const auto v = random.matrix<Positions>(3, mesh.X.cols());
    Positions f = Positions::Zero(3, mesh.X.cols());
    dashpots.add_force(x, v, f);
    const double expected = dot(f, v);
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(dashpots.power(x, v), expected, 1e-12 * expected);
  });
}

// v = A X strains all of it alike: V (2η |dev E|² + ζ tr² E), E = sym(FᵀA), in elements, domains
// and shares of both.
TEST(Dashpots, ThatStrainAlikeLoseWhatTheLawSays) {
  const Vec3 size(0.02, 0.03, 0.01);
  const TetMesh mesh = box_mesh({2, 3, 2}, size, 0.1);
  const double eta = 3, zeta = 7;
  for_plain_and_smoothed(mesh, {eta, zeta}, [&](const Dashpots& dashpots, const BlockMatrix&) {
    Random random;
    const Mat3 F = Mat3::Identity() + 0.3 * random.matrix3(), A = random.matrix3();
    const Mat3 E = 0.5 * (F.transpose() * A + A.transpose() * F);
    const Mat3 distortion = E - E.trace() / 3 * Mat3::Identity();
    const double expected =
        size.prod() * (2 * eta * distortion.squaredNorm() + zeta * E.trace() * E.trace());
    EXPECT_NEAR(dashpots.power(F * mesh.X, A * mesh.X), expected, 1e-12 * expected);
  });
}

TEST(Dashpots, TheirMatrixIsTheDerivativeOfTheirForce) {
  constexpr double kDamping = 30, kStiffness = 0.7, kStep = 1e-6;
  const TetMesh mesh = box_mesh({2, 1, 1}, Vec3(0.02, 0.03, 0.01), 0.1);
  for_plain_and_smoothed(mesh, {3, 7}, [&](const Dashpots& dashpots, BlockMatrix K) {
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
  });
}

// A preconditioner has them in the elements alone.
TEST(Dashpots, OfSmoothedElementsHaveAPlainMatrixThatIsThatOfPlainOnes) {
  const TetMesh mesh = box_mesh({2, 3, 2}, Vec3(0.02, 0.03, 0.01), 0.1);
  const SmoothedElasticity smoothed = smoothed_elements(mesh);
  BlockMatrix found = smoothed.make_plain_matrix(), expected = found;
  Random random;
  const Positions x = mesh.X + 1e-3 * random.matrix<Positions>(3, mesh.X.cols());
  Dashpots(smoothed, {3, 0}).add_plain_damping(x, 20, found);
  Dashpots(mesh.X, mesh.tets, {3, 0}, expected).add_tangent(x, x, 20, 0, expected);
  const auto u = random.matrix<Eigen::VectorXd>(3 * mesh.X.cols(), 1);
  Eigen::VectorXd of_found, of_expected;
  found.multiply(u, of_found);
  expected.multiply(u, of_expected);
  EXPECT_GT(of_expected.norm(), 0);
  EXPECT_LT((of_found - of_expected).norm(), 1e-12 * of_expected.norm());
}

}  // namespace articular::fem::dashpots_test
