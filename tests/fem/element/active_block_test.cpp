#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/dense.hpp"

// A block of muscle with its fibres along x. Three of its faces may slide in their planes, so that
// the state stays homogeneous and the closed form is that of one element.
namespace articular::fem::active_block_test {

const Vec3 kSize(0.04, 0.02, 0.01);  // [m]
const double kArea = kSize.y() * kSize.z();
constexpr double kRoundOff = 1e-9;  // [-] of forces, of Newton's last step

class Block {
 public:
  explicit Block(AnyMaterial material)
      : mesh_(box_mesh({2, 2, 2}, kSize, 0.15)),
        x_(mesh_.X),
        elasticity_(mesh_.X, mesh_.tets, std::move(material),
                    Vec3(1, 0, 0).replicate(1, mesh_.tets.cols())) {}

  /// Newton's method to equilibrium from where the block is, with x = 0, y = 0 and z = 0 as planes
  /// of symmetry. @param end_fixed  whether the face at x = L keeps its x, or is free
  void settle(double activation, bool end_fixed) {
    std::vector<int> free;
    for (int a = 0; a < x_.cols(); ++a) {
      for (int i = 0; i < 3; ++i) {
        const bool on_plane = mesh_.X(i, a) < 1e-9;
        if (!on_plane && !(i == 0 && end_fixed && at_end(a))) free.push_back(3 * a + i);
      }
    }
    const double tolerance = kRoundOff * 1e5 * kArea;
    for (int step = 0; step < 40; ++step) {
      const Eigen::VectorXd r = internal_force(activation).reshaped()(free);
      if (r.norm() < tolerance) return;
      BlockMatrix K = elasticity_.make_matrix();
      elasticity_.add_stiffness(x_, Tangent::Consistent, 1, K, activation);
      const Eigen::MatrixXd K_free = dense(K)(free, free);
      x_.reshaped()(free) -= K_free.partialPivLu().solve(r);
    }
    FAIL() << "no equilibrium at activation " << activation;
  }

  void stretch(double s) { x_ = Vec3(s, 1, 1).asDiagonal() * mesh_.X; }
  /// What the face at x = L pulls with [N].
  double end_force(double activation) const {
    const Positions f = internal_force(activation);
    double force = 0;
    for (int a = 0; a < f.cols(); ++a) force += at_end(a) ? f(0, a) : 0;
    return force;
  }
  Eigen::VectorXd fibre_stretch() const { return elasticity_.fibre_stretch(x_); }

 private:
  bool at_end(int a) const { return mesh_.X(0, a) > kSize.x() - 1e-9; }
  Positions internal_force(double activation) const {
    Positions f = Positions::Zero(3, x_.cols());
    elasticity_.add_internal_force(x_, f, activation);
    return f;
  }

  TetMesh mesh_;
  Positions x_;
  Elasticity elasticity_;
};

// Clamped to the stretch s, with free sides: the fibres pull along x alone, so that nothing presses
// on the sides, J changes with s only by what the ground does, which is nothing here, and the force
// is that of the force-length curve, σ_max (f_p + a f_a) n/s times the area at rest, at any κ.
TEST(ActiveBlock, IsometricForceIsThatOfTheForceLengthCurve) {
  const double activation = 0.5;
  const MuscleFibre fibre({});
  Block block(BlemkerMuscle<>(fibre, {.kappa = 1e8}));
  for (const double s : {1.0, 0.5, 0.7, 0.9, 1.2, 1.3, 1.5}) {
    block.stretch(s);
    block.settle(activation, true);
    const double force = block.end_force(activation);
    EXPECT_NEAR(force, fibre.tension(s, activation) * kArea, kRoundOff * 1e5 * kArea) << s;
    const double passive = s > 1 ? 0.05 * std::expm1(6.6 * (std::min(s, 1.4) - 1)) +
                                       std::max(s - 1.4, 0.0) * 0.33 * std::exp(2.64)
                                 : 0;
    const double incompressible = 0.3e6 * (passive + activation * MuscleFibre::active(s)) * kArea;
    EXPECT_NEAR(force, incompressible, 0.01 * incompressible) << s;
    EXPECT_LT((block.fibre_stretch().array() - s).abs().maxCoeff(), kRoundOff);
  }
}

// σ_max times area, where everyone expects it: full activation, at rest length.
TEST(ActiveBlock, FullyActiveMuscleAtRestLengthPullsWithItsStressTimesItsArea) {
  Block block(BlemkerMuscle<>(MuscleFibre({}), {.kappa = 1e9}));
  block.settle(1, true);
  EXPECT_NEAR(block.end_force(1), 0.3e6 * kArea, 1e-3 * 0.3e6 * kArea);
  Block ligament(TransverselyIsotropic<LogVolumeChange>(
      2e4, 0, ToeLinearFibre({.c3 = 1e3, .c4 = 20, .c5 = 1e6, .toe_end = 1.1}), 1e9,
      ActiveFibre({.stress = 1e5})));
  ligament.settle(1, true);
  EXPECT_NEAR(ligament.end_force(1), 1e5 * kArea, 1e-3 * 1e5 * kArea);
}

// With a ForceLength the force is a σ_a f times area over the length; without fibres that are taut
// and with a soft ground nothing else pulls.
TEST(ActiveBlock, IsometricForceFollowsTheLengthOfTheSarcomeres) {
  const double kappa = 1e8, activation = 0.6, T = 135.7e3;
  const ForceLength curve({.calcium = 3});
  const ToeLinearFibre fibre({.c3 = 1e-3, .c4 = 1, .c5 = 1e-3, .toe_end = 3});
  Block block(TransverselyIsotropic<LogVolumeChange>(
      1e3, 0, fibre, kappa, ActiveFibre({.stress = T, .force_length = curve})));
  for (const double s : {1.0, 0.8, 0.9, 1.1, 1.2}) {
    block.stretch(s);
    block.settle(activation, true);
    const double active = activation * T * curve.factor(s);
    const double expected = (2e3 * (s * s - 1 / s) + active) / s * kArea;
    EXPECT_NEAR(block.end_force(activation), expected, 0.003 * T * kArea) << s;
  }
  EXPECT_NEAR(curve.factor(1) / curve.factor(1.2), 0.6119, 1e-4);  // it matters
}

/// Where a falling or rising function changes sign.
template <class Function>
double root(const Function& f, double low, double high) {
  const bool rises = f(high) > 0;
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    ((f(middle) > 0) == rises ? high : low) = middle;
  }
  return (low + high) / 2;
}

// Without a load the stresses of ground and fibre cancel: 2 c10 (λ̄² − 1/λ̄) + s dW/ds = 0. Sides
// are free too where κ ln J is a third of the ground's; that is s dW/ds / −3.
TEST(ActiveBlock, FreeBlockShortensUntilTheStressesAlongTheFibreCancel) {
  const double c10 = 2e4, kappa = 1e7;
  const auto expect_balance = [&](Block& block, const auto& fibre) {
    for (int percent = 5; percent <= 95; percent += 5) {
      const double activation = percent / 100.0;
      block.settle(activation, false);
      const auto stress = [&](double s) {
        const double active = s * fibre.tension(s, activation);
        const double isochoric = s * std::exp(active / (9 * kappa));
        return 2 * c10 * (isochoric * isochoric - 1 / isochoric) + active;
      };
      const double s = root(stress, 0.3, 1);
      EXPECT_LT((block.fibre_stretch().array() - s).abs().maxCoeff(), kRoundOff) << activation;
      EXPECT_NEAR(block.end_force(activation), 0, kRoundOff * 1e5 * kArea);
    }
    EXPECT_LT(block.fibre_stretch()[0], 0.75);
  };
  const MuscleFibre muscle({});
  Block block(BlemkerMuscle<>(muscle, {.c10 = c10, .kappa = kappa}));
  expect_balance(block, muscle);
  const ActiveFibre active({.stress = 5e4});
  Block generic(TransverselyIsotropic<LogVolumeChange>(
      c10, 0, ToeLinearFibre({.c3 = 1e3, .c4 = 20, .c5 = 1e6, .toe_end = 1.1}), kappa, active));
  expect_balance(generic, active);
}

// As published, without a ground substance: it shortens until the fibre pulls no more, at 0.4 of
// the length of the largest force. The curve ends there as a parabola, 9 (n − 0.4)² σ_max: the
// tolerance of the force, 2e-8 N, is one of 6e-6 of the length.
TEST(ActiveBlock, PublishedMuscleShortensToTheFootOfTheForceLengthCurve) {
  Block block(BlemkerMuscle<>(MuscleFibre({}), {.kappa = 1e6}));
  block.stretch(0.45);
  block.settle(1, false);
  EXPECT_NEAR(block.fibre_stretch()[0], 0.4, 1e-5);
}

std::string refusal(const FibreDirections& fibres, const AnyMaterial& material) {
  const TetMesh mesh = box_mesh({1, 1, 1}, kSize);
  try {
    const Elasticity elasticity(mesh.X, mesh.tets, material, fibres);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Elasticity, RefusesFibresThatAreMissingOrHaveNoDirection) {
  const AnyMaterial muscle = BlemkerMuscle<>(MuscleFibre({}), {}), plain = NeoHookean(1e4, 0.4);
  FibreDirections fibres = Vec3(0, 1, 0).replicate(1, 6);
  EXPECT_EQ(refusal(fibres, muscle), "");
  EXPECT_EQ(refusal({}, plain), "");
  EXPECT_NE(refusal({}, muscle).find("0 directions of fibres for 6"), std::string::npos);
  EXPECT_NE(refusal(fibres.leftCols(4), plain).find("4 directions"), std::string::npos);
  for (const Vec3& bad : {Vec3(0, 0, 0), Vec3(0, 1, std::numeric_limits<double>::quiet_NaN())}) {
    fibres.col(3) = bad;
    EXPECT_NE(refusal(fibres, muscle).find("tetrahedron 3 (nodes"), std::string::npos);
    EXPECT_NE(refusal(fibres, muscle).find("must be finite and not 0"), std::string::npos);
  }
}

}  // namespace articular::fem::active_block_test
