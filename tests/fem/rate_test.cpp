#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/corotated.hpp"
#include "fem/mooney_rivlin.hpp"
#include "fem/prony.hpp"
#include "fem/viscosity.hpp"
#include "tests/fem/central_difference.hpp"
#include "tests/fem/random_matrices.hpp"

// Effects of the rate: dashpots and relaxation.
namespace articular::fem {
namespace {

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
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Mat9>(D).eigenvalues()[0], -kIdentity * D.norm());
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

const std::vector<PronyTerm> kTerms{{0.154, 3.77}, {0.161, 148}, {0.3, 0.2}};

/// Runs a history S0(t) in equal steps and returns S at its end.
Mat3 relaxed(const PronySeries& series, const std::function<Mat3(double)>& S0, double end,
             int steps) {
  std::vector<Mat3> h(static_cast<std::size_t>(series.num_terms()), Mat3::Zero());
  const double dt = end / steps;
  Mat3 S = S0(0);
  for (int n = 0; n < steps; ++n) {
    const Mat3 at = S0(n * dt), next = S0((n + 1) * dt);
    S = series.instantaneous_fraction(dt) * next + series.memory(h, at, dt);
    series.advance(at, next, dt, h);
    Mat3 sum = series.equilibrium_fraction() * next;
    for (const Mat3& h_i : h) sum += h_i;
    EXPECT_LT((S - sum).norm(), kIdentity * (1 + S.norm()));  // the two forms are one
  }
  return S;
}

// S/S0 = 1 − Σ g (1 − exp(−t/τ)), exactly, in steps of any size.
TEST(PronySeries, SuddenStressRelaxesAsTheSeriesSays) {
  const PronySeries series(kTerms);
  const Mat3 S0 = Random().matrix3();
  for (const double end : {0.01, 1.0, 30.0, 1e4}) {
    for (const int steps : {1, 7, 100}) {
      std::vector<Mat3> h(3, Mat3::Zero());
      series.advance(Mat3::Zero(), S0, 0, h);  // sudden
      EXPECT_EQ(series.instantaneous_fraction(0), 1);
      const double dt = end / steps;
      Mat3 S = S0;
      for (int n = 0; n < steps; ++n) {
        S = series.instantaneous_fraction(dt) * S0 + series.memory(h, S0, dt);
        series.advance(S0, S0, dt, h);
      }
      double expected = 1;
      for (const auto& [g, tau] : kTerms) expected -= g * (1 - std::exp(-end / tau));
      EXPECT_LT((S - expected * S0).norm(), kIdentity);
    }
  }
  EXPECT_NEAR(series.equilibrium_fraction(), 1 - 0.154 - 0.161 - 0.3, kIdentity);
}

// A ramp S0 = t A: S = (1 − Σ g) t A + Σ g τ (1 − exp(−t/τ)) A, exactly in any steps.
TEST(PronySeries, RampIsIntegratedExactly) {
  const PronySeries series(kTerms);
  const Mat3 A = Random().matrix3();
  for (const int steps : {1, 3, 50}) {
    const double end = 5;
    double expected = series.equilibrium_fraction() * end;
    for (const auto& [g, tau] : kTerms) expected += g * tau * (1 - std::exp(-end / tau));
    const Mat3 S = relaxed(
        series, [&A](double t) { return Mat3(t * A); }, end, steps);
    EXPECT_LT((S - expected * A).norm(), kIdentity * 10);
  }
}

// S0 = sin(ωt) A has h = g ωτ/(1 + ω²τ²) (cos ωt + ωτ sin ωt − exp(−t/τ)) A.
TEST(PronySeries, IsOfSecondOrderInTheStep) {
  const PronySeries series(kTerms);
  const Mat3 A = Random().matrix3();
  const double omega = 2, end = 3;
  double expected = series.equilibrium_fraction() * std::sin(omega * end);
  for (const auto& [g, tau] : kTerms) {
    const double x = omega * tau;
    expected += g * x / (1 + x * x) *
                (std::cos(omega * end) + x * std::sin(omega * end) - std::exp(-end / tau));
  }
  const auto error = [&](int steps) {
    const auto S0 = [&](double t) { return Mat3(std::sin(omega * t) * A); };
    return (relaxed(series, S0, end, steps) - expected * A).norm();
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 2, 0.1);
  EXPECT_NEAR(std::log2(error(40) / error(80)), 2, 0.05);
}

// The work of a cycle of strain that starts and ends at rest, with the elastic energy that is left
// in the dashpots only adding to it: never negative, and, slow or fast beyond all relaxation times,
// nothing.
TEST(PronySeries, CyclesOfStrainLoseEnergy) {
  const PronySeries series(kTerms);
  const IsochoricMooneyRivlin law(3e3, 1e3);
  Random random;
  for (int k = 0; k < 5; ++k) {
    const Mat3 A = 0.3 * random.matrix3(), B = 0.3 * random.matrix3();
    const auto F_at = [&](double phase) {
      return Mat3(Mat3::Identity() + std::sin(2 * std::numbers::pi * phase) * A +
                  (1 - std::cos(2 * std::numbers::pi * phase)) * B);
    };
    const auto work = [&](double period) {
      constexpr int kSteps = 2000;
      std::vector<Mat3> h(3, Mat3::Zero());
      double sum = 0;
      Mat3 S0 = Mat3::Zero(), F = F_at(0), P = Mat3::Zero();
      for (int n = 1; n <= kSteps; ++n) {
        const Mat3 F_next = F_at(static_cast<double>(n) / kSteps);
        const Mat3 P0 = law.first_piola(F_next), S0_next = F_next.inverse() * P0;
        const double dt = period / kSteps;
        const Mat3 P_next = relaxed_first_piola(P0, F_next, series.instantaneous_fraction(dt),
                                                series.memory(h, S0, dt));
        sum += 0.5 * (P + P_next).cwiseProduct(F_next - F).sum();
        series.advance(S0, S0_next, dt, h);
        S0 = S0_next;
        F = F_next;
        P = P_next;
      }
      return sum;
    };
    const double medium = work(2);
    EXPECT_GT(medium, 0);
    EXPECT_GT(work(20), 0);
    EXPECT_GT(work(0.2), 0);
    EXPECT_LT(std::abs(work(1e-6)), 1e-3 * medium);
    EXPECT_LT(std::abs(work(1e8)), 1e-3 * medium);
  }
}

TEST(PronySeries, RelaxedTangentIsTheDerivativeOfTheRelaxedStress) {
  const PronySeries series(kTerms);
  const IsochoricMooneyRivlin law(3e3, 1e3);
  Random random;
  const Mat3 F_n = random_gradient(random), F = random_gradient(random);
  const Mat3 A = random.matrix3();
  std::vector<Mat3> h(3, 1e3 * (A + A.transpose()));
  const double dt = 0.3, fraction = series.instantaneous_fraction(dt);
  const Mat3 memory = series.memory(h, F_n.inverse() * law.first_piola(F_n), dt);
  const auto stress = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    const Mat3 at = v.reshaped(3, 3);
    return relaxed_first_piola(law.first_piola(at), at, fraction, memory).reshaped();
  };
  const Mat9 C = relaxed_tangent(law.tangent(F), fraction, memory);
  EXPECT_LT(derivative_error(stress, F.reshaped(), C, 1), kDerivative);
  EXPECT_LT((C - C.transpose()).norm(), kIdentity * C.norm());
}

// One strain history in two bodies, one of which turns while it is strained.
TEST(PronySeries, RelaxedStressTurnsWithARotation) {
  const PronySeries series(kTerms);
  const IsochoricMooneyRivlin law(3e3, 1e3);
  Random random;
  std::vector<Mat3> h(3, Mat3::Zero()), h_turned = h;
  Mat3 S0 = Mat3::Zero(), S0_turned = S0;
  for (int n = 0; n < 5; ++n) {
    const Mat3 F = random_gradient(random), Q = random.rotation(), QF = Q * F;
    const double dt = 0.5, fraction = series.instantaneous_fraction(dt);
    const Mat3 P0 = law.first_piola(F), P0_turned = law.first_piola(QF);
    const Mat3 P = relaxed_first_piola(P0, F, fraction, series.memory(h, S0, dt));
    const Mat3 P_turned =
        relaxed_first_piola(P0_turned, QF, fraction, series.memory(h_turned, S0_turned, dt));
    EXPECT_LT((P_turned - Q * P).norm(), 1e-11 * P.norm());
    const Mat3 S0_next = F.inverse() * P0, S0_turned_next = QF.inverse() * P0_turned;
    series.advance(S0, S0_next, dt, h);
    series.advance(S0_turned, S0_turned_next, dt, h_turned);
    S0 = S0_next;
    S0_turned = S0_turned_next;
  }
}

std::string message_of(const std::vector<PronyTerm>& terms) {
  try {
    const PronySeries series(terms);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(PronySeries, RefusesWhatIsNoRelaxation) {
  EXPECT_EQ(message_of({}), "");
  EXPECT_EQ(message_of({{0.154, 3.77}, {0.161, 148}, {0.682, 10988}}), "");  // a ligament
  EXPECT_NE(message_of({{0.5, 0}}).find("relaxation time is 0 s"), std::string::npos);
  EXPECT_NE(message_of({{-0.5, 1}}).find("weight of a relaxation time is -0.5"), std::string::npos);
  EXPECT_NE(message_of({{0.5, 1}, {0.5, 2}}).find("sum up to 1, must be below 1"),
            std::string::npos);
}

}  // namespace
}  // namespace articular::fem
