#include "fem/material/fibre.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>

#include "fem/material/any_material.hpp"
#include "fem/material/blemker_muscle.hpp"
#include "fem/material/transversely_isotropic.hpp"
#include "fem/material/veronda_westmann.hpp"
#include "fem/material/yeoh.hpp"
#include "tests/fem/support/laws.hpp"

namespace articular::fem::fibre_test {

constexpr double kRoundOff = 1e-12;  // [-] relative

/// ∫ of a function with kinks, by the midpoint rule: error about 1e-9 of its slope.
double integral(const std::function<double(double)>& f, double from, double to) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += f(from + (to - from) * (i + 0.5) / kSteps);
  return sum * (to - from) / kSteps;
}

TEST(ToeLinearFibre, CauchyStressIsThePublishedOne) {
  // Constants of the cruciate ligament; numbers by hand from the formulas.
  const ToeLinearFibre fibre = cruciate_fibre();
  for (const double slack : {0.3, 0.9, 1.0}) EXPECT_EQ(fibre.cauchy_stress(slack), 0);
  EXPECT_NEAR(fibre.cauchy_stress(1.03), 0.0139e6 * (std::exp(3.4866) - 1), 1e-6);
  const double end = 0.0139e6 * (std::exp(116.22 * 0.046) - 1);  // 2.902 MPa
  EXPECT_NEAR(end, 2.902e6, 1e3);
  EXPECT_NEAR(fibre.cauchy_stress(1.046), end, 1e-12 * 535e6);
  EXPECT_NEAR(fibre.cauchy_stress(1.1), end + 535.039e6 * 0.054, 1e-12 * 535e6);
  EXPECT_NEAR(fibre.cauchy_stress(3), end + 535.039e6 * 1.954, 1e-12 * 1e9);  // no exponential
}

TEST(ActiveFibre, StressIsTheActivationTimesItsLargestAndTheForceLength) {
  const ForceLength curve({.calcium = 3.1});
  const ActiveFibre even({.stress = 5e6}), sarcomeres({.stress = 5e6, .force_length = curve});
  for (const double stretch : {0.7, 1.0, 1.03, 1.4}) {
    EXPECT_NEAR(even.tension(stretch, 0.5), 2.5e6, 1e-6);
    EXPECT_NEAR(stretch * sarcomeres.tension(stretch, 0.5), 2.5e6 * curve.factor(stretch), 1e-6);
    EXPECT_EQ(even.tension(stretch, 0), 0);
    EXPECT_EQ(ActiveFibre().tension(stretch, 1), 0);
  }
}

// Numbers by hand: f = 1 − exp(−B (l − l0)) where all calcium is there, B (l − l0) = 1.2825 at
// rest.
TEST(ForceLength, IsThePublishedOne) {
  const ForceLength whole({});
  EXPECT_NEAR(whole.factor(1), 1 - std::exp(-4.75 * 0.27), kRoundOff);
  EXPECT_NEAR(whole.factor(2.2 / 1.85), 1 - std::exp(-4.75 * 0.62), kRoundOff);
  for (const double slack : {0.1, 0.8, 1.579 / 1.85}) EXPECT_EQ(whole.factor(slack), 0);
  const ForceLength half({.calcium = 2.175});
  for (const double l : {1.6, 1.85, 2.1, 2.4}) {
    const double ECa50 = 4.35 / std::sqrt(std::expm1(4.75 * (l - 1.58)));
    EXPECT_NEAR(half.factor(l / 1.85), 2.175 * 2.175 / (2.175 * 2.175 + ECa50 * ECa50), kRoundOff);
  }
  EXPECT_EQ(whole.factor(1e3), 1);  // no overflow
  EXPECT_EQ(half.slope(1e3), 0);
}

// The work has no closed form: it is compared with a fine midpoint rule, beyond where f is 1 too,
// and with the stress by differences everywhere, also where panels of its quadrature meet.
TEST(ForceLength, WorkIsTheIntegralOfTheStress) {
  for (const ForceLength& law :
       {ForceLength({}), ForceLength({.calcium = 0.5}), ForceLength({.b = 0.2e6}),
        ForceLength({.zero_length = 0.1e-6, .b = 40e6})}) {
    const auto stress = [&](double s) { return law.factor(s) / s; };
    EXPECT_EQ(law.work(0.02), 0);
    double before = 0.02;
    for (const double s : {0.5, 0.86, 1.0, 1.3, 2.0, 6.0, 30.0}) {
      EXPECT_NEAR(law.work(s) - law.work(before), integral(stress, before, s), 1e-6) << s;
      before = s;
    }
    const double h = 1e-4;
    for (int k = 0; k < 212; ++k) {
      const double s = 0.3 + 0.0317 * k;  // to 7
      const double difference =
          (law.work(s - 2 * h) - 8 * law.work(s - h) + 8 * law.work(s + h) - law.work(s + 2 * h)) /
          (12 * h);
      if (std::abs(s - 1.58 / 1.85) < 3 * h) continue;  // the kink
      EXPECT_NEAR(difference, stress(s), 3e-11) << s;
      const double slope = (law.factor(s + h) - law.factor(s - h)) / (2 * h);
      EXPECT_NEAR(law.slope(s), slope, 1e-4) << s;
    }
  }
}

// With all calcium there, f = 1 − exp(−b (λ − λ0)), the work is an exponential integral.
TEST(ForceLength, WorkIsTheClosedFormWhereAllCalciumIsThere) {
  const ForceLength law({});
  const double b = 4.75 * 1.85, zero = 1.58 / 1.85;
  for (const double s : {0.86, 0.9, 1.0, 1.2, 1.7, 3.0, 6.0, 20.0}) {
    const double expected =
        std::log(s / zero) - std::exp(b * zero) * (std::expint(-b * s) - std::expint(-b * zero));
    EXPECT_NEAR(law.work(s), expected, 1e-13 + 1e-13 * expected) << s;
  }
}

TEST(MuscleFibre, ForceLengthCurveIsThePublishedOne) {
  EXPECT_EQ(MuscleFibre::active(1), 1);
  for (const double out : {0.2, 0.39, 1.61, 3.0}) EXPECT_EQ(MuscleFibre::active(out), 0);
  EXPECT_NEAR(MuscleFibre::active(0.5), 0.09, kRoundOff);
  EXPECT_NEAR(MuscleFibre::active(1.5), 0.09, kRoundOff);
  EXPECT_NEAR(MuscleFibre::active(0.8), 0.84, kRoundOff);
  EXPECT_NEAR(MuscleFibre::active(1.2), 0.84, kRoundOff);
  for (const double corner : {0.4, 0.6, 1.4, 1.6}) {  // no jump
    EXPECT_NEAR(MuscleFibre::active(corner - 1e-9), MuscleFibre::active(corner + 1e-9), 1e-8);
  }
}

TEST(MuscleFibre, PassiveTensionIsExponentialAndThenLinear) {
  const MuscleFibre fibre({.max_stress = 1, .optimal_stretch = 1.1});
  const auto passive = [&](double n) { return 1.1 * fibre.tension(1.1 * n, 0); };
  EXPECT_EQ(passive(0.9), 0);
  EXPECT_NEAR(passive(1.2), 0.05 * (std::exp(6.6 * 0.2) - 1), kRoundOff);
  const double end = 0.05 * (std::exp(6.6 * 0.4) - 1), slope = 0.05 * 6.6 * std::exp(6.6 * 0.4);
  EXPECT_NEAR(passive(1.4), end, kRoundOff);
  EXPECT_NEAR(passive(2.4), end + slope, kRoundOff);
  EXPECT_NEAR(1.1 * fibre.tension(1.1, 0.5), 0.5, kRoundOff);  // the isometric force
}

// Half of the line is tendon: what the line stretches by, the fibres stretch by twice.
TEST(MuscleFibre, WithoutADescendingLimbPullsAsHardBeyondItsOptimum) {
  const MuscleFibre published({}), level({.descending_limb = false});
  const auto pull = [](const MuscleFibre& fibre, double stretch) {
    return fibre.tension(stretch, 1) - fibre.tension(stretch, 0);
  };
  for (const double stretch : {0.5, 0.8, 1.0})
    EXPECT_EQ(pull(level, stretch), pull(published, stretch));
  for (const double stretch : {1.1, 1.5, 2.0}) EXPECT_NEAR(pull(level, stretch), 0.3e6, 1e-6);
}

TEST(MuscleFibre, TendonLeavesItsShareOfTheStretchToTheFibres) {
  const MuscleFibre bare({.max_stress = 1}), half({.max_stress = 1, .tendon_ratio = 0.5});
  for (const double strain : {-0.25, -0.1, 0.0, 0.15, 0.3}) {
    EXPECT_NEAR(half.tension(1 + strain, 0.7), bare.tension(1 + 2 * strain, 0.7), kRoundOff);
    EXPECT_NEAR(half.stiffness(1 + strain, 0.7), 2 * bare.stiffness(1 + 2 * strain, 0.7),
                kRoundOff);
  }
  EXPECT_EQ(half.tension(0.7, 1), 0);  // the fibres are at 0.4 of their length
}

template <class Law>
void expect_consistent(const Law& law, double scale) {
  for (const double activation : {0.0, 0.6}) {
    for (const double stretch : {0.35, 0.5, 0.8, 0.97, 1.02, 1.04, 1.2, 1.5, 1.7, 3.0}) {
      const double energy = law.energy(stretch, activation) - law.energy(0.3, activation);
      EXPECT_NEAR(integral([&](double s) { return law.tension(s, activation); }, 0.3, stretch),
                  energy, 1e-7 * scale)
          << stretch;
      const double h = 1e-5;
      const double slope =
          (law.tension(stretch + h, activation) - law.tension(stretch - h, activation)) / (2 * h);
      EXPECT_NEAR(law.stiffness(stretch, activation), slope, 1e-5 * scale) << stretch;
    }
  }
}

TEST(FibreLaw, EnergyTensionAndStiffnessBelongTogether) {
  expect_consistent(cruciate_fibre(), 535e6);
  expect_consistent(cardiac_fibre(), 1e6);
  expect_consistent(cardiac_activity(), 1e6);
  expect_consistent(ActiveFibre({.stress = 5e6}), 5e6);
  expect_consistent(MuscleFibre({}), 0.3e6);
  expect_consistent(MuscleFibre({.optimal_stretch = 1.1}), 0.3e6);
  expect_consistent(MuscleFibre({.optimal_stretch = 1.1, .tendon_ratio = 0.5}), 0.3e6);
  expect_consistent(MuscleFibre({.tendon_ratio = 0.3, .descending_limb = false}), 0.3e6);
}

Mat3 along_fibre(double stretch) {
  Mat3 frame;
  frame << kFibre, kAcross, kFibre.cross(kAcross);
  const double side = 1 / std::sqrt(stretch);
  return frame * Vec3(stretch, side, side).asDiagonal() * frame.transpose();
}

template <class Law>
double stress_along_fibre(const Law& law, double stretch) {
  const Mat3 F = along_fibre(stretch);
  const Mat3 sigma = law.first_piola(F) * F.transpose();
  return kFibre.dot(sigma * kFibre) - kAcross.dot(sigma * kAcross);
}

// Incompressible uniaxial stress along the fibres: σ = 2 (λ² − 1/λ)(c10 + c01/λ) + λ dW/dλ.
TEST(TransverselyIsotropic, StressAlongTheFibreAddsThatOfGroundAndFibre) {
  const ToeLinearFibre fibre = cruciate_fibre();
  const ActiveFibre active({.stress = 5e6});
  for (const double activation : {0.0, 0.4}) {
    const auto law =
        TransverselyIsotropic<>(1.95e6, 0.5e6, fibre, 146e6, active).along(kFibre, activation);
    for (const double s : {0.8, 1.0, 1.03, 1.1, 1.5}) {
      const double expected = 2 * (s * s - 1 / s) * (1.95e6 + 0.5e6 / s) + fibre.cauchy_stress(s) +
                              5e6 * activation * s;
      EXPECT_NEAR(stress_along_fibre(law, s), expected, 1e-11 * 1e8);
    }
  }
}

// Where it is drawn, prestretched tissue carries what free tissue carries at that stretch; and
// drawn back by it, nothing.
TEST(TransverselyIsotropic, PrestretchIsWhereTheCurveBegins) {
  const ToeLinearFibre fibre = cruciate_fibre();
  for (const double prestretch : {0.97, 1.03, 1.08}) {
    const auto law =
        TransverselyIsotropic<>(1.95e6, 0.5e6, fibre, 146e6, {}, prestretch).along(kFibre, 0);
    for (const double length : {1 / prestretch, 0.98, 1.0, 1.05}) {
      const double s = prestretch * length;
      const double expected = 2 * (s * s - 1 / s) * (1.95e6 + 0.5e6 / s) + fibre.cauchy_stress(s);
      EXPECT_NEAR(stress_along_fibre(law, length), expected, 1e-11 * 1e8);
    }
  }
}

// Just taut, a fibre adds c3 c4 to the stiffness along it; just slack, nothing.
TEST(TransverselyIsotropic, SmallStrainModulusAlongTheFibreJumpsWhereItBecomesTaut) {
  const double c10 = 1.95e6, c3 = 0.0139e6, c4 = 116.22, strain = 1e-7;
  const auto law = TransverselyIsotropic<>(c10, 0, cruciate_fibre(), 146e6).along(kFibre, 0);
  EXPECT_NEAR(stress_along_fibre(law, 1 + strain) / strain, 6 * c10 + c3 * c4, 1e-4 * c10);
  EXPECT_NEAR(stress_along_fibre(law, 1 - strain) / -strain, 6 * c10, 1e-4 * c10);
}

constexpr double kG1 = 500, kG2 = 800, kC10 = 200;  // [Pa]
auto muscle(double activation, double c10 = kC10) {
  return BlemkerMuscle<>(MuscleFibre({}), {.G1 = kG1, .G2 = kG2, .c10 = c10})
      .along(kFibre, activation);
}

// The five deviatoric modes of small strain: two shears along the fibre, two across, and the
// stretch along the fibre with even sides, which meets the ground substance and, taut, the fibre:
// the passive slope at n = 1 is σ_max P1 P2.
TEST(BlemkerMuscle, SmallStrainModuliAreThoseOfAlongAndAcross) {
  const Mat9 C = muscle(0).tangent(Mat3::Identity());
  const Vec3 n = kFibre.cross(kAcross);
  const auto modulus = [&C](const Vec3& a, const Vec3& b) {  // per engineering shear
    const Vec9 shear = (0.5 * (a * b.transpose() + b * a.transpose())).eval().reshaped();
    return shear.dot(C * shear);
  };
  EXPECT_NEAR(modulus(kFibre, kAcross), 2 * (kG1 + kC10), 1e-8 * kG1);
  EXPECT_NEAR(modulus(kFibre, n), 2 * (kG1 + kC10), 1e-8 * kG1);
  EXPECT_NEAR(modulus(kAcross, n), 2 * (kG2 + kC10), 1e-8 * kG1);
  EXPECT_NEAR(modulus((kAcross + n) / std::sqrt(2.0), (kAcross - n) / std::sqrt(2.0)),
              2 * (kG2 + kC10), 1e-8 * kG1);
  const double strain = 1e-7, passive_slope = 0.3e6 * 0.05 * 6.6;
  EXPECT_NEAR(stress_along_fibre(muscle(0), 1 - strain) / strain, -6 * kC10, 0.1);
  EXPECT_NEAR(stress_along_fibre(muscle(0), 1 + strain) / strain, 6 * kC10 + passive_slope, 1);
}

// Fibres that slide along each other by γ keep their length: σ = 2 (G1 + c10) γ, B2 stays 0. A
// cross section drawn to η, 1/η: B2 = 2 ln η, and the stresses differ by 8 G2 ln η + 2 c10 (η² −
// η⁻²).
TEST(BlemkerMuscle, LargeShearsFollowTheClosedForms) {
  const Vec3 n = kFibre.cross(kAcross);
  for (const double shear : {0.1, 1.0, 3.0}) {
    const Mat3 F = Mat3::Identity() + shear * kFibre * kAcross.transpose();
    const Mat3 sigma = muscle(0).first_piola(F) * F.transpose();
    EXPECT_NEAR(kFibre.dot(sigma * kAcross), 2 * (kG1 + kC10) * shear, 1e-8 * kG1);
    EXPECT_NEAR(kAcross.dot(sigma * kAcross) - n.dot(sigma * n), 0, 1e-8 * kG1);
  }
  for (const double eta : {0.5, 0.99, 1.2, 2.0}) {
    const Mat3 F = kFibre * kFibre.transpose() + eta * kAcross * kAcross.transpose() +
                   1 / eta * n * n.transpose();
    const Mat3 sigma = muscle(0).first_piola(F) * F.transpose();
    EXPECT_NEAR(kAcross.dot(sigma * kAcross) - n.dot(sigma * n),
                8 * kG2 * std::log(eta) + 2 * kC10 * (eta * eta - 1 / (eta * eta)), 1e-8 * kG2);
  }
}

// A tension along the fibre and nothing across it, at any change of volume.
TEST(ActiveStress, PullsAlongTheFibresAlone) {
  for (const double swelling : {0.8, 1.0, 1.1}) {
    const Mat3 F = swelling * Mat3::Identity();
    const Mat3 active = muscle(1).first_piola(F) - muscle(0).first_piola(F);
    const double expected = 0.3e6 * MuscleFibre::active(swelling);
    EXPECT_LT((active - expected * kFibre * kFibre.transpose()).norm(), 1e-9 * expected);

    const TransverselyIsotropic<> collagen(2e4, 0, cruciate_fibre(), 1e6,
                                           ActiveFibre({.stress = 1e5}));
    const Mat3 other =
        collagen.along(kFibre, 1).first_piola(F) - collagen.along(kFibre, 0).first_piola(F);
    EXPECT_LT((other - 1e5 * kFibre * kFibre.transpose()).norm(), 1e-9 * 1e5);
  }
}

// Muscle that contracts is stiffer to shear: by 2 c10 of the activation along the fibres.
TEST(BlemkerMuscle, ActivationStiffensTheGroundSubstance) {
  const BlemkerMuscle<> law(MuscleFibre({}), {.c10 = 1e4, .active_c10 = 3e4});
  const Mat3 shear = kAcross * kFibre.cross(kAcross).transpose();  // across, no fibre feels it
  const auto modulus = [&](double activation) {
    constexpr double kStep = 1e-5;
    const auto at = law.along(kFibre, activation);
    return (at.first_piola(Mat3::Identity() + kStep * shear) -
            at.first_piola(Mat3::Identity() - kStep * shear))
               .cwiseProduct(shear)
               .sum() /
           (2 * kStep);
  };
  EXPECT_NEAR(modulus(0.5) - modulus(0), 2 * 0.5 * 3e4, 1e-3 * 3e4);
}

// Twice as many fibres pull twice as hard, and the ground stays what it is.
TEST(FibreDensity, MultipliesWhatFibresPull) {
  const Mat3 F = Vec3(1.2, 0.9, 0.95).asDiagonal();
  const BlemkerMuscle<> law(MuscleFibre({.optimal_stretch = 1.05}), {.c10 = 1e4});
  const auto difference = [&](double density) {
    const auto dense = law.along(density * kFibre, 0.6), single = law.along(kFibre, 0.6);
    return std::tuple(dense.energy_density(F) - single.energy_density(F),
                      Mat3(dense.first_piola(F) - single.first_piola(F)),
                      Mat9(dense.tangent(F) - single.tangent(F)));
  };
  const auto [energy, stress, tangent] = difference(2);
  const auto [energy3, stress3, tangent3] = difference(3);
  EXPECT_GT(energy, 0);
  EXPECT_NEAR(energy3, 2 * energy, kRoundOff * energy3);
  EXPECT_LT((stress3 - 2 * stress).norm(), kRoundOff * stress3.norm());
  EXPECT_LT((tangent3 - 2 * tangent).norm(), kRoundOff * tangent3.norm());
  EXPECT_GT(stress.norm(), 1e4);
}

// Swelling alone does not draw the fibres of collagen, as published.
TEST(TransverselyIsotropic, PassiveFibresDoNotFeelTheVolume) {
  const auto law = TransverselyIsotropic<>(2e4, 0, cruciate_fibre(), 1e6).along(kFibre, 0);
  const Mat3 stress = law.first_piola(1.1 * Mat3::Identity());
  EXPECT_LT((stress - stress.trace() / 3 * Mat3::Identity()).norm(), 1e-6);
}

// As published nothing resists a slack fibre that shortens with even sides; c10 does.
TEST(BlemkerMuscle, PassiveShorteningMeetsOnlyTheGroundSubstance) {
  for (const double s : {0.6, 0.8, 0.95}) {
    EXPECT_NEAR(stress_along_fibre(muscle(0, 0), s), 0, 1e-8 * kG1);
    EXPECT_NEAR(stress_along_fibre(muscle(0), s), 2 * kC10 * (s * s - 1 / s), 1e-8 * kG1);
    EXPECT_NEAR(stress_along_fibre(muscle(1, 0), s), 0.3e6 * s * MuscleFibre::active(s), 1e-6);
  }
}

// acosh² by its series and by its closed form.
TEST(FibreShear, SquaredAcoshIsSmoothAtOne) {
  for (const double y : {1.0999999, 1.1000001, 1.5, 4.0}) {
    const double a = std::acosh(y), s = std::sqrt(y * y - 1);
    const auto [value, first, second] = squared_acosh(y);
    EXPECT_NEAR(value, a * a, 1e-14);
    EXPECT_NEAR(first, 2 * a / s, 1e-13);
    EXPECT_NEAR(second, 2 * (1 - y * a / s) / (s * s), 1e-12);
  }
  const auto [value, first, second] = squared_acosh(1);
  EXPECT_EQ(value, 0);
  EXPECT_EQ(first, 2);
  EXPECT_NEAR(second, -2.0 / 3, 1e-15);
}

std::string message_of(const std::function<void()>& make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}
/// That the message has each of these parts.
void expect_refusal(const std::function<void()>& make, std::initializer_list<const char*> parts) {
  const std::string message = message_of(make);
  EXPECT_NE(message, "");
  for (const char* part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(Materials, RefuseBadConstantsAndSayWhy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message_of([] { (void)cruciate_fibre(); }), "");
  expect_refusal([] { (void)MooneyRivlin<>(-1, 2, 3); }, {"c10", "-1 Pa", "not negative"});
  expect_refusal([] { (void)MooneyRivlin<>(0, 0, 3); }, {"c10 + c01", "0 Pa", "positive"});
  expect_refusal([] { (void)MooneyRivlin<>(1, 0, 0); }, {"bulk modulus", "0 Pa", "positive"});
  expect_refusal([] { (void)Yeoh<>(0, 1, 1); }, {"c10", "0 Pa", "positive"});
  expect_refusal([] { (void)Yeoh<>(1, -2, 1); }, {"c20", "-2 Pa", "not negative"});
  expect_refusal([] { (void)VerondaWestmann<>(0, 1, 1); }, {"c1", "0 Pa", "positive"});
  expect_refusal([] { (void)VerondaWestmann<>(1, -3, 1); }, {"c2", "-3", "positive"});
  expect_refusal([] { (void)ToeLinearFibre({.c3 = 0, .c4 = 1, .c5 = 1, .toe_end = 1.1}); },
                 {"c3", "0 Pa"});
  expect_refusal([] { (void)ToeLinearFibre({.c3 = 1, .c4 = -1, .c5 = 1, .toe_end = 1.1}); },
                 {"c4", "-1"});
  expect_refusal([] { (void)ToeLinearFibre({.c3 = 1, .c4 = 1, .c5 = -2, .toe_end = 1.1}); },
                 {"c5", "-2 Pa"});
  expect_refusal([] { (void)ToeLinearFibre({.c3 = 1, .c4 = 1, .c5 = 1, .toe_end = 1}); },
                 {"toe", "above 1"});
  expect_refusal([] { (void)ToeLinearFibre({.c3 = 1, .c4 = 1e3, .c5 = 1, .toe_end = 1.1}); },
                 {"1100", "700"});
  for (const double s : {3.0, 0.0, nan})
    expect_refusal([s] { (void)TransverselyIsotropic<>(1, 0, cruciate_fibre(), 1, {}, s); },
                   {"prestretch", "between 0.5 and 2"});
  expect_refusal([] { (void)ActiveFibre({.stress = -5}); }, {"active stress", "-5 Pa"});
  expect_refusal([] { (void)MuscleFibre({.max_stress = -1}); }, {"active stress", "-1 Pa"});
  expect_refusal([] { (void)MuscleFibre({.p1 = 0}); }, {"P1", "positive"});
  expect_refusal([] { (void)MuscleFibre({.p2 = 0}); }, {"P2", "positive"});
  expect_refusal([] { (void)MuscleFibre({.p2 = 2000}); }, {"P2", "800", "700"});
  expect_refusal([] { (void)MuscleFibre({.toe_end = 0.9}); }, {"toe", "0.9", "above 1"});
  expect_refusal([] { (void)MuscleFibre({.optimal_stretch = 0.9}); }, {"0.9", "at least 1"});
  expect_refusal([] { (void)MuscleFibre({.tendon_ratio = -0.1}); }, {"tendon ratio", "-0.1"});
  expect_refusal([] { (void)MuscleFibre({.tendon_ratio = 1}); }, {"tendon ratio", "below 1"});
  expect_refusal([] { (void)MuscleFibre({.max_velocity = 0}); }, {"speed of shortening", "0"});
  expect_refusal([] { (void)BlemkerMuscle<>(MuscleFibre({}), {.G1 = 0}); }, {"G1", "0 Pa"});
  expect_refusal([] { (void)BlemkerMuscle<>(MuscleFibre({}), {.G2 = -1}); }, {"G2", "-1 Pa"});
  expect_refusal([] { (void)BlemkerMuscle<>(MuscleFibre({}), {.c10 = -1}); }, {"c10", "-1 Pa"});
  expect_refusal([] { (void)BlemkerMuscle<>(MuscleFibre({}), {.kappa = 0}); },
                 {"bulk modulus", "0 Pa"});
  expect_refusal([] { (void)StVenantKirchhoff(0, 0.3); }, {"Young's modulus", "0 Pa"});
  expect_refusal([] { (void)CoupledNeoHookean(1, 0.5); }, {"Poisson's ratio", "0.5"});
  expect_refusal([] { (void)HolmesMow(1, 0.2, 0); }, {"beta", "0", "positive"});
  for (const double nu : {-0.1, 0.34})
    expect_refusal([nu] { (void)HolmesMow(1, nu, 1); }, {"Poisson's ratio", "0 and 1/3"});
  EXPECT_EQ(message_of([] { (void)HolmesMow(1, 0.333333, 1); }), "");
  expect_refusal([] { (void)Ogden<>({}, 1); }, {"no term"});
  expect_refusal([] { (void)Ogden<>({{1, 2}, {-1, 3}}, 1); }, {"c is -1 Pa", "positive"});
  expect_refusal([] { (void)Ogden<>({{1, 0}}, 1); }, {"m is 0", "away from 0"});
  expect_refusal([] { (void)Ogden<>({{1, 2}}, 0); }, {"bulk modulus", "0 Pa"});
  expect_refusal([&] { (void)Ogden<>({{1, nan}}, 1); }, {"m is nan"});
  expect_refusal([] { (void)ForceLength({.sarcomere_length = 0}); }, {"sarcomere length", "0 m"});
  expect_refusal([] { (void)ForceLength({.zero_length = -1}); }, {"without active", "-1 m"});
  expect_refusal([] { (void)ForceLength({.b = 0}); }, {"b is 0", "positive"});
  expect_refusal([] { (void)ForceLength({.calcium = 0}); }, {"calcium is 0"});
  expect_refusal([] { (void)ForceLength({.calcium = 5}); }, {"calcium is 5", "4.35"});
  EXPECT_NE(message_of([&] { (void)Yeoh<>(nan, 0, 1); }), "");
  EXPECT_NE(message_of([&] { (void)MuscleFibre({.toe_end = nan}); }), "");
}

}  // namespace articular::fem::fibre_test
