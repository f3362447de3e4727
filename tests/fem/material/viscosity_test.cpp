#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "fem/base/cofactor.hpp"
#include "fem/material/any_material.hpp"
#include "fem/material/corotated.hpp"
#include "fem/material/mooney_rivlin.hpp"
#include "fem/material/viscosity.hpp"
#include "fem/simd/viscosity_kernels.hpp"
#include "tests/fem/support/central_difference.hpp"
#include "tests/fem/support/instruction_sets.hpp"
#include "tests/fem/support/random_matrices.hpp"
#include "tests/fem/support/spectrum.hpp"

// Dashpots, in each instruction set that this machine has.
namespace articular::fem::viscosity_test {

/// One point by the kernels, in one lane of eight; the others move otherwise.
class Dashpot {
 public:
  Dashpot(const KelvinVoigt& law, InstructionSet set, int lane = 5)
      : law_(law), kernels_(viscosity_kernels(set)), lane_(lane) {}

  Mat3 first_piola(const Mat3& F, const Mat3& rate) const {
    const Points of_F(F, lane_), of_rate(rate, lane_);
    Eight P[9];
    kernels_.first_piola(motions(of_F, of_rate), P);
    Mat3 result;
    for (int k = 0; k < 9; ++k) result.reshaped()[k] = P[k].lane[lane_];
    return result;
  }
  /// damping ∂P/∂Ḟ + stiffness times the symmetric part of ∂P/∂F
  Mat9 tangent(const Mat3& F, const Mat3& rate, double damping, double stiffness) const {
    const Points of_F(F, lane_), of_rate(rate, lane_);
    Eight C[81];
    kernels_.tangent(motions(of_F, of_rate), damping, stiffness, C);
    Mat9 result;
    for (int k = 0; k < 81; ++k) result.reshaped()[k] = C[k].lane[lane_];
    return result;
  }

 private:
  struct Points {
    Eight entry[9];
    Points(const Mat3& A, int at) {
      for (int k = 0; k < 9; ++k)
        for (int lane = 0; lane < kBatchSize; ++lane)
          entry[k].lane[lane] = lane == at ? A.reshaped()[k] : 10.0 * lane - k;
    }
  };
  EightMotions motions(const Points& F, const Points& rate) const {
    return {F.entry, rate.entry, law_.eta(), law_.lambda()};
  }

  KelvinVoigt law_;
  const ViscosityKernels& kernels_;
  int lane_;
};

void for_each_set(const KelvinVoigt& law, const std::function<void(const Dashpot&)>& use) {
  for (const InstructionSet set : instruction_sets())
    for (const int lane : {0, 5, 7}) use(Dashpot(law, set, lane));
}

constexpr double kIdentity = 1e-12;   // [-] relative, a few roundings
constexpr double kDerivative = 1e-8;  // [-] relative, best of a sweep of central differences

Mat3 random_gradient(Random& random) {
  return random.rotation() * Vec3(1.5, 1.1, 0.6).asDiagonal() * random.rotation();
}

TEST(KelvinVoigt, TangentsAreTheDerivativesOfTheStress) {
  for_each_set({3, 7}, [](const Dashpot& dashpot) {
    Random random;
    for (int k = 0; k < 4; ++k) {
      const Mat3 F = random_gradient(random), rate = random.matrix3();
      const auto of_F = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
        return dashpot.first_piola(v.reshaped(3, 3), rate).reshaped();
      };
      const auto of_rate = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
        return dashpot.first_piola(F, v.reshaped(3, 3)).reshaped();
      };
      const Mat9 D = dashpot.tangent(F, rate, 1, 0);
      EXPECT_LT(derivative_error(of_rate, rate.reshaped(), D, 1), kDerivative);
      EXPECT_LT((D - D.transpose()).norm(), kIdentity * D.norm());
      EXPECT_GT(eigenvalues(D)[0], -kIdentity * D.norm());
      // Of the symmetric part: along one direction, and by two that differ.
      const Mat9 K = dashpot.tangent(F, rate, 0, 1);
      const auto a = random.matrix<Eigen::VectorXd>(9, 1), b = random.matrix<Eigen::VectorXd>(9, 1);
      const auto slope = [&](const Eigen::VectorXd& along, const Eigen::VectorXd& of) {
        constexpr double h = 1e-6;
        const Eigen::VectorXd at = F.reshaped();
        return of.dot(of_F(at + h * along) - of_F(at - h * along)) / (2 * h);
      };
      EXPECT_NEAR(a.dot(K * b), 0.5 * (slope(a, b) + slope(b, a)), 1e-7 * K.norm());
      EXPECT_LT((K - K.transpose()).norm(), kIdentity * K.norm());
      EXPECT_LT((dashpot.tangent(F, rate, 2, 3) - (2 * D + 3 * K)).norm(), kIdentity * 100);
    }
  });
}

TEST(KelvinVoigt, DissipatesInEveryMotionThatStrains) {
  const double eta = 3, zeta = 7;
  Random random;
  for (int k = 0; k < 200; ++k) {
    const Mat3 F = random_gradient(random), rate = random.matrix3();
    const auto loss = [&](double shear, double bulk) {
      return Dashpot({shear, bulk}, best_instruction_set())
          .first_piola(F, rate)
          .cwiseProduct(rate)
          .sum();
    };
    const Mat3 strain_rate = 0.5 * (F.transpose() * rate + rate.transpose() * F);
    const double trace = strain_rate.trace();
    const double expected =
        2 * eta * (strain_rate - trace / 3 * Mat3::Identity()).squaredNorm() + zeta * trace * trace;
    EXPECT_NEAR(loss(eta, zeta), expected, kIdentity * 100);
    EXPECT_GE(loss(eta, 0), 0);
    EXPECT_GE(loss(0, zeta), 0);
  }
}

// A body that turns as a whole, F' = Q F with Q' = W Q, has Ḟ' = W Q F + Q Ḟ.
TEST(KelvinVoigt, DoesNotFeelRotations) {
  for_each_set({3, 7}, [](const Dashpot& dashpot) {
    Random random;
    for (int k = 0; k < 4; ++k) {
      const Mat3 F = random_gradient(random), rate = random.matrix3(), Q = random.rotation();
      const Mat3 W = 100 * cross_matrix(random.matrix<Vec3>(3, 1));
      EXPECT_LT(dashpot.first_piola(F, W * F).norm(), kIdentity * 1e3);
      const Mat3 turned = dashpot.first_piola(Q * F, W * Q * F + Q * rate);
      EXPECT_LT((turned - Q * dashpot.first_piola(F, rate)).norm(), kIdentity * 1e3);
    }
  });
}

// At rest β K and the dashpot are one, for any isotropic law.
TEST(Rayleigh, StiffnessDampingIsBetaTimesTheStiffnessAtRest) {
  const double beta = 0.03;
  const Corotated corotated(2e4, 0.4);
  const MooneyRivlin<> mooney_rivlin(3e3, 1e3, 1e5);
  const auto expect_proportional = [&](const auto& law) {
    const Dashpot dashpot(stiffness_damping(beta, law.shear_modulus(), law.bulk_modulus()),
                          best_instruction_set());
    const Mat9 D = dashpot.tangent(Mat3::Identity(), Mat3::Zero(), 1, 0);
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
  const Dashpot dashpot(stiffness_damping(beta, law.shear_modulus(), law.bulk_modulus()),
                        best_instruction_set());
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
