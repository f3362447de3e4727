#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/base/cofactor.hpp"
#include "fem/material/any_material.hpp"
#include "fem/material/corotated.hpp"
#include "fem/material/mooney_rivlin.hpp"
#include "fem/material/viscosity.hpp"
#include "tests/fem/support/central_difference.hpp"
#include "tests/fem/support/random_matrices.hpp"
#include "tests/fem/support/spectrum.hpp"

// Dashpots.
namespace articular::fem::viscosity_test {

constexpr double kIdentity = 1e-12;   // [-] relative, a few roundings
constexpr double kDerivative = 1e-8;  // [-] relative, best of a sweep of central differences

Mat3 random_gradient(Random& random) {
  return random.rotation() * Vec3(1.5, 1.1, 0.6).asDiagonal() * random.rotation();
}

TEST(KelvinVoigt, TangentsAreTheDerivativesOfTheStress) {
  const KelvinVoigt dashpot(3, 7);
  Random random;
  for (int k = 0; k < 10; ++k) {
    const Mat3 F = random_gradient(random), rate = random.matrix3();
    const auto of_F = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      return dashpot.first_piola(v.reshaped(3, 3), rate).reshaped();
    };
    const auto of_rate = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      return dashpot.first_piola(F, v.reshaped(3, 3)).reshaped();
    };
    EXPECT_LT(derivative_error(of_F, F.reshaped(), dashpot.tangent(F, rate), 1), kDerivative);
    const Mat9 D = dashpot.rate_tangent(F);
    EXPECT_LT(derivative_error(of_rate, rate.reshaped(), D, 1), kDerivative);
    EXPECT_LT((D - D.transpose()).norm(), kIdentity * D.norm());
    EXPECT_GT(eigenvalues(D)[0], -kIdentity * D.norm());
  }
}

TEST(KelvinVoigt, DissipatesInEveryMotionThatStrains) {
  const double eta = 3, zeta = 7;
  Random random;
  for (int k = 0; k < 200; ++k) {
    const Mat3 F = random_gradient(random), rate = random.matrix3();
    const Mat3 strain_rate = 0.5 * (F.transpose() * rate + rate.transpose() * F);
    const double trace = strain_rate.trace();
    const double expected =
        2 * eta * (strain_rate - trace / 3 * Mat3::Identity()).squaredNorm() + zeta * trace * trace;
    EXPECT_NEAR(KelvinVoigt(eta, zeta).dissipation(F, rate), expected, kIdentity * 100);
    EXPECT_GE(KelvinVoigt(eta, 0).dissipation(F, rate), 0);
    EXPECT_GE(KelvinVoigt(0, zeta).dissipation(F, rate), 0);
  }
}

// A body that turns as a whole, F' = Q F with Q' = W Q, has Ḟ' = W Q F + Q Ḟ.
TEST(KelvinVoigt, DoesNotFeelRotations) {
  const KelvinVoigt dashpot(3, 7);
  Random random;
  for (int k = 0; k < 10; ++k) {
    const Mat3 F = random_gradient(random), rate = random.matrix3(), Q = random.rotation();
    const Mat3 W = 100 * cross_matrix(random.matrix<Vec3>(3, 1));
    EXPECT_LT(dashpot.first_piola(F, W * F).norm(), kIdentity * 1e3);
    const Mat3 turned = dashpot.first_piola(Q * F, W * Q * F + Q * rate);
    EXPECT_LT((turned - Q * dashpot.first_piola(F, rate)).norm(), kIdentity * 1e3);
  }
}

// At rest β K and the dashpot are one, for any isotropic law.
TEST(Rayleigh, StiffnessDampingIsBetaTimesTheStiffnessAtRest) {
  const double beta = 0.03;
  const Corotated corotated(2e4, 0.4);
  const MooneyRivlin<> mooney_rivlin(3e3, 1e3, 1e5);
  const auto expect_proportional = [&](const auto& law) {
    const Mat9 D = stiffness_damping(beta, law.shear_modulus(), law.bulk_modulus())
                       .rate_tangent(Mat3::Identity());
    const Mat9 K = law.tangent(Mat3::Identity());
    EXPECT_LT((D - beta * K).norm(), kIdentity * D.norm());
  };
  expect_proportional(corotated);
  expect_proportional(mooney_rivlin);
  EXPECT_THROW((void)stiffness_damping(-1, 1, 1), std::invalid_argument);
}

TEST(Rayleigh, MassDampingIsAlphaTimesTheMomentum) {
  Positions v(3, 2), f = Positions::Ones(3, 2);
  v << 1, 0, 2, 0, 0, -3;
  add_mass_damping(2, Eigen::Vector2d(0.1, 0.5), v, f);
  Positions expected(3, 2);
  expected << 1.2, 1, 1.4, 1, 1, -2;
  EXPECT_LT((f - expected).norm(), kIdentity);
}

// A confined column with a mass at its end, F = diag(1 + q, 1, 1): m q̈ + α m q̇ + P_xx + P_v,xx = 0
// with the stiffness k = κ + 4μ/3. Swings so small that they are linear decay as exp(−ζ ω t),
// ζ = α/(2ω) + βω/2: over one period of ω_d = ω √(1 − ζ²) to exp(−2π ζ/√(1 − ζ²)).
TEST(Rayleigh, SwingsDecayWithTheDampingRatio) {
  const MooneyRivlin<> law(3e3, 1e3, 1e5);
  const double alpha = 40, beta = 1e-4, m = 0.5;
  const KelvinVoigt dashpot = stiffness_damping(beta, law.shear_modulus(), law.bulk_modulus());
  const double omega = std::sqrt((1e5 + 4.0 / 3 * 8e3) / m);
  const double zeta = alpha / (2 * omega) + beta * omega / 2, root = std::sqrt(1 - zeta * zeta);
  const auto acceleration = [&](double q, double v) {
    Mat3 F = Mat3::Identity(), rate = Mat3::Zero();
    F(0, 0) += q;
    rate(0, 0) = v;
    return -(law.first_piola(F)(0, 0) + dashpot.first_piola(F, rate)(0, 0)) / m - alpha * v;
  };
  constexpr int kSteps = 1000;
  const double start = 1e-6, period = 2 * std::numbers::pi / (omega * root), dt = period / kSteps;
  double q = start, v = -zeta * omega * start;  // the slope of exp(−ζωt) cos(ω_d t) at 0
  for (int n = 0; n < kSteps; ++n) {            // Runge–Kutta
    const double k1 = acceleration(q, v), v2 = v + dt / 2 * k1;
    const double k2 = acceleration(q + dt / 2 * v, v2), v3 = v + dt / 2 * k2;
    const double k3 = acceleration(q + dt / 2 * v2, v3), v4 = v + dt * k3;
    const double k4 = acceleration(q + dt * v3, v4);
    q += dt / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  EXPECT_NEAR(q / start, std::exp(-2 * std::numbers::pi * zeta / root), 1e-5);
}

TEST(KelvinVoigt, RefusesNegativeViscosities) {
  EXPECT_THROW(KelvinVoigt(-1, 0), std::invalid_argument);
  EXPECT_THROW(KelvinVoigt(1, -1e-3), std::invalid_argument);
  EXPECT_NO_THROW(KelvinVoigt(0, 0));
}

}  // namespace articular::fem::viscosity_test
