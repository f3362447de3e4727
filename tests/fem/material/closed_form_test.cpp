#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"

// Stresses of homogeneous states against closed forms. States of J = 1 have an exact one with any
// bulk modulus: the pressure that the volumetric energy does not give there drops out of the
// difference of two principal stresses, of which the second is 0 on a free side.
namespace articular::fem::closed_form_test {

constexpr double kRoundOff = 1e-13;  // [-] relative to modulus and stress

template <class Law>
Mat3 cauchy(const Law& law, const Mat3& F) {
  return law.first_piola(F) * F.transpose() / F.determinant();
}
/// σ_xx − σ_zz at the stretches (a, b, 1/(a b)) [Pa]
template <class Law>
double principal_difference(const Law& law, double a, double b) {
  const Mat3 sigma = cauchy(law, Vec3(a, b, 1 / (a * b)).asDiagonal());
  return sigma(0, 0) - sigma(2, 2);
}
template <class Law>
double uniaxial(const Law& law, double s) {
  return principal_difference(law, s, 1 / std::sqrt(s));
}

struct TableRow {
  double stretch, uniaxial, nominal, equibiaxial, planar;  // stresses per μ
};
/// From the closed forms μ(λ² − 1/λ), μ(λ − 1/λ²), μ(λ² − 1/λ⁴), μ(λ² − 1/λ²), to six digits.
constexpr TableRow kTable[] = {{0.5, -1.75, -3.5, -15.75, -3.75},
                               {0.7, -0.938571, -1.340816, -3.674931, -1.550816},
                               {0.9, -0.301111, -0.334568, -0.714158, -0.424568},
                               {1.1, 0.300909, 0.273554, 0.526987, 0.383554},
                               {1.3, 0.920769, 0.708284, 1.339872, 1.098284},
                               {1.5, 1.583333, 1.055556, 2.052469, 1.805556},
                               {2.0, 3.5, 1.75, 3.9375, 3.75}};

template <class Law>
void expect_neo_hookean_stresses(const Law& law, double mu) {
  constexpr double kDigits = 6e-7;  // the table is rounded to six
  for (const auto& row : kTable) {
    const double s = row.stretch, scale = kRoundOff * 100 * mu;
    EXPECT_NEAR(uniaxial(law, s), mu * (s * s - 1 / s), scale);
    EXPECT_NEAR(principal_difference(law, s, s), mu * (s * s - std::pow(s, -4)), scale);
    EXPECT_NEAR(principal_difference(law, s, 1), mu * (s * s - 1 / (s * s)), scale);
    EXPECT_NEAR(uniaxial(law, s) / mu, row.uniaxial, kDigits);
    EXPECT_NEAR(uniaxial(law, s) / s / mu, row.nominal, kDigits);
    EXPECT_NEAR(principal_difference(law, s, s) / mu, row.equibiaxial, kDigits);
    EXPECT_NEAR(principal_difference(law, s, 1) / mu, row.planar, kDigits);
  }
}

TEST(ClosedForm, NeoHookeanSolidsHaveTheStressesOfTheTable) {
  const double E = 2e4, nu = 0.45, mu = lame_parameters(E, nu).mu;
  expect_neo_hookean_stresses(isochoric_neo_hookean<VolumeChange>(E, nu), mu);
  expect_neo_hookean_stresses(isochoric_neo_hookean<LogVolumeChange>(E, nu), mu);
  expect_neo_hookean_stresses(NeoHookean(E, nu), mu);
  expect_neo_hookean_stresses(Yeoh<>(mu / 2, 0, 1e5), mu);
}

// Simple shear γ: σ_xy = μ γ, and the normal stress difference σ_xx − σ_yy = μ γ² (Poynting). With
// Mooney–Rivlin μ = 2 (c10 + c01) for both, and σ_yy − σ_zz = −2 c01 γ².
TEST(ClosedForm, SimpleShearHasNormalStresses) {
  const double c10 = 3e3, c01 = 1e3, mu = 2 * (c10 + c01);
  Mat3 F = Mat3::Identity();
  for (const double shear : {0.1, 1.0, 2.0}) {
    F(0, 1) = shear;
    const double scale = kRoundOff * 100 * mu;
    const Mat3 neo = cauchy(NeoHookean(2 * mu * 1.4, 0.4), F);
    EXPECT_NEAR(neo(0, 1), mu * shear, scale);
    EXPECT_NEAR(neo(0, 0) - neo(1, 1), mu * shear * shear, scale);
    EXPECT_NEAR(neo(1, 1) - neo(2, 2), 0, scale);
    const Mat3 mooney = cauchy(MooneyRivlin<>(c10, c01, 1e5), F);
    EXPECT_NEAR(mooney(0, 1), mu * shear, scale);
    EXPECT_NEAR(mooney(0, 0) - mooney(1, 1), mu * shear * shear, scale);
    EXPECT_NEAR(mooney(1, 1) - mooney(2, 2), -2 * c01 * shear * shear, scale);
  }
}

// An isochoric law of Ī1 and Ī2 has σ = 2 (λ² − 1/λ)(∂Ψ/∂I1 + ∂Ψ/∂I2/λ) in uniaxial stress.
TEST(ClosedForm, UniaxialStressFollowsFromTheDerivativesByTheInvariants) {
  const MooneyRivlin<> mooney_rivlin(3e3, 1e3, 1e5);
  const Yeoh<> yeoh(1037, 486, 10370);
  const VerondaWestmann<> skin(1e4, 2, 1e5);
  for (const auto& row : kTable) {
    const double s = row.stretch, I1 = s * s + 2 / s;
    const auto expected = [s](double by_I1, double by_I2) {
      return 2 * (s * s - 1 / s) * (by_I1 + by_I2 / s);
    };
    const double of_mooney = expected(3e3, 1e3);
    const double of_yeoh = expected(1037 + 2 * 486 * (I1 - 3), 0);
    const double of_skin = expected(2e4 * std::exp(2 * (I1 - 3)), -1e4);
    EXPECT_NEAR(uniaxial(mooney_rivlin, s), of_mooney, 100 * kRoundOff * 1e5);
    EXPECT_NEAR(uniaxial(yeoh, s), of_yeoh, 100 * kRoundOff * 1e4);
    EXPECT_NEAR(uniaxial(skin, s), of_skin, 100 * kRoundOff * (1e5 + std::abs(of_skin)));
  }
}

// Beyond the exponent 100 the exponential goes on as its quadratic: energy, stress and stiffness
// have no jump where it is left, and follow the closed form of the quadratic.
TEST(ClosedForm, VerondaWestmannGoesOnAsAQuadraticBeyondItsLargestExponent) {
  const VerondaWestmann<> skin(1e4, 20, 1e5);
  const double c1 = 1e4, c2 = 20, largest = std::exp(100.0);
  const auto energy = [&](double s) {
    return skin.energy_density(Vec3(s, 1 / std::sqrt(s), 1 / std::sqrt(s)).asDiagonal());
  };
  const double border = 2.7159;  // λ² + 2/λ − 3 = 5 at 2.7110...
  for (const double s : {border, 3.0, 5.0}) {
    const double I1 = s * s + 2 / s, I2 = 2 * s + 1 / (s * s), d = c2 * (I1 - 3) - 100;
    ASSERT_GT(d, 0);
    const double expected = c1 * (largest * (1 + d + d * d / 2) - 1 - c2 / 2 * (I2 - 3));
    EXPECT_NEAR(energy(s) / expected, 1, 1e-11);
    const double slope = 2 * (s * s - 1 / s) * c1 * c2 * (largest * (1 + d) - 0.5 / s);
    EXPECT_NEAR(uniaxial(skin, s) / slope, 1, 1e-11);
  }
}

/// Side stretch at which the sides of uniaxial tension are free, by Newton's method from 1/√s.
double free_side(const std::function<Jet(const Mat3&)>& law, double s) {
  double t = 1 / std::sqrt(s);
  for (int step = 0; step < 20; ++step) {
    const Jet at = law(Vec3(s, t, t).asDiagonal());
    t -= at.gradient(1, 1) / (at.hessian(4, 4) + at.hessian(4, 8));
  }
  return t;
}

struct NearlyIncompressible {
  double stretch, side, stress, volume, stress_of_log;
};

// E = 1, ν = 0.49 in uniaxial stress, to six digits, with either volumetric energy.
TEST(ClosedForm, NearlyIncompressibleBarHasTheStressesOfTheTable) {
  constexpr double kDigits = 6e-7;
  for (const auto& row : {NearlyIncompressible{0.7, 1.191455, -0.315240, 0.993695, -0.315237},
                          NearlyIncompressible{1.2, 0.914705, 0.201105, 1.004022, 0.201090},
                          NearlyIncompressible{1.5, 0.820731, 0.519951, 1.010399, 0.519777}}) {
    const auto square = isochoric_neo_hookean<VolumeChange>(1, 0.49);
    const auto log = isochoric_neo_hookean<LogVolumeChange>(1, 0.49);
    const auto jet = [](const auto& law) {
      return [&law](const Mat3& F) {
        return Jet{law.energy_density(F), law.first_piola(F), law.tangent(F)};
      };
    };
    const double s = row.stretch, t = free_side(jet(square), s), t_log = free_side(jet(log), s);
    EXPECT_NEAR(t, row.side, kDigits);
    EXPECT_NEAR(s * t * t, row.volume, kDigits);
    EXPECT_NEAR(cauchy(square, Vec3(s, t, t).asDiagonal())(0, 0), row.stress, kDigits);
    EXPECT_NEAR(cauchy(log, Vec3(s, t_log, t_log).asDiagonal())(0, 0), row.stress_of_log, kDigits);
  }
}

}  // namespace articular::fem::closed_form_test
