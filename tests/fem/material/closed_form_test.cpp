#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/fem/support/central_difference.hpp"
#include "tests/fem/support/laws.hpp"

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

// With Ĩ = λ̃1^m + ..., J = 1: σ_xx − σ_zz = Σ c/m (λ1^m − λ3^m). One term of m = 2 is neo-Hookean
// with c10 = c/4, m = ±2 is Mooney–Rivlin.
TEST(ClosedForm, OgdenSolidsHaveTheDifferenceOfThePowersOfTheirStretches) {
  const std::vector<OgdenTerm> terms{{4e3, 2.5}, {1e3, -3}, {200, 7}};
  const Ogden<> ogden(terms, 1e5);
  const auto expected = [&](double x, double z) {
    double sum = 0;
    for (const auto& [c, m] : terms) sum += c / m * (std::pow(x, m) - std::pow(z, m));
    return sum;
  };
  const double mu = 2e4 / 2.9;
  expect_neo_hookean_stresses(Ogden<LogVolumeChange>({{2 * mu, 2}}, 1e5), mu);
  const MooneyRivlin<> mooney(3e3, 1e3, 1e5);
  const Ogden<> same({{12e3, 2}, {4e3, -2}}, 1e5);
  for (const auto& row : kTable) {
    const double s = row.stretch;
    for (const double t : {1 / std::sqrt(s), s, 1.0}) {
      const double of_terms = expected(s, 1 / (s * t));
      EXPECT_NEAR(principal_difference(ogden, s, t), of_terms,
                  100 * kRoundOff * (1e5 + std::abs(of_terms)));
      EXPECT_NEAR(principal_difference(same, s, t), principal_difference(mooney, s, t),
                  100 * kRoundOff * 1e6);
    }
  }
}

/// Any F of these stretches, in axes of its own.
Mat3 turned(const Vec3& stretches) {
  const Mat3 U = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Mat3 V = Eigen::AngleAxisd(-1.9, Vec3(2, 0, 1).normalized()).toRotationMatrix();
  return U * stretches.asDiagonal() * V.transpose();
}

// Where stretches coincide, or all but coincide, the tangent is the derivative of the stress, and
// that of the same law in its invariants.
TEST(ClosedForm, OgdenTangentIsRightWhereStretchesCoincide) {
  const Ogden<> ogden({{4e3, 2.5}, {1e3, -3}, {200, 7}}, 2e4);
  const Ogden<> powers({{12e3, 2}, {4e3, -2}}, 2e4);
  const MooneyRivlin<> invariants(3e3, 1e3, 2e4);
  const auto stress = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return ogden.first_piola(Mat3(v.reshaped(3, 3))).reshaped();
  };
  for (const double gap : {0.0, 1e-16, 3e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2}) {
    for (const Vec3& stretches :
         {Vec3(1, 1, 1 + gap), Vec3(1 + gap, 1 - gap, 1), Vec3(1.3, 1.3 + gap, 0.6),
          Vec3(0.7, 1.4, 0.7 - gap), Vec3(0.8, 0.8 + gap, 0.8 - gap)}) {
      for (const Mat3& F : {Mat3(stretches.asDiagonal()), turned(stretches)}) {
        const Mat9 C = ogden.tangent(F);
        EXPECT_LT(derivative_error(stress, F.reshaped(), C, 1), 1e-8) << gap << "\n" << F;
        EXPECT_LT((powers.tangent(F) - invariants.tangent(F)).norm(),
                  1e-12 * invariants.tangent(F).norm())
            << gap << "\n"
            << F;
      }
    }
  }
}

struct Coupled {
  const char* name;
  std::function<Jet(const Mat3&)> law;
  // First Piola stress along x of the stretch s, with fixed sides and with free ones [Pa].
  std::function<double(double s)> confined, free;
};

template <class M>
std::function<Jet(const Mat3&)> jet_of(const M& m) {
  return [m](const Mat3& F) { return Jet{m.energy_density(F), m.first_piola(F), m.tangent(F)}; };
}

/// Where a rising function is 0.
double root(const std::function<double(double)>& f, double low, double high) {
  for (int k = 0; k < 200; ++k) (f((low + high) / 2) > 0 ? high : low) = (low + high) / 2;
  return (low + high) / 2;
}

std::vector<Coupled> coupled_laws() {
  const double E = 2e4, nu = 0.3, beta = 0.7;
  const Lame lame = lame_parameters(E, nu);
  const double mu = lame.mu, lambda = lame.lambda, H = lambda + 2 * mu;
  std::vector<Coupled> laws;
  // Free sides of t² = 1 − ν (s² − 1): Young's modulus times the strain, (s² − 1)/2.
  laws.push_back({"st-venant-kirchhoff", jet_of(StVenantKirchhoff(E, nu)),
                  [=](double s) { return H / 2 * s * (s * s - 1); },
                  [=](double s) { return E / 2 * s * (s * s - 1); }});
  // Free sides where μ (t² − 1) + λ ln(s t²) = 0; Kirchhoff's stresses differ by μ (s² − t²).
  laws.push_back({"coupled-neo-hookean", jet_of(CoupledNeoHookean(E, nu)),
                  [=](double s) { return mu * (s - 1 / s) + lambda * std::log(s) / s; },
                  [=](double s) {
                    const auto side = [&](double t) {
                      return mu * (t * t - 1) + lambda * std::log(s * t * t);
                    };
                    const double t = root(side, 0.1, 10);
                    return mu * (s * s - t * t) / s;
                  }});
  // Q' of each stretch k is 2 a1 λk + 2 a2 λk (sum of the other squares) − 2β/λk.
  laws.push_back(
      {"holmes-mow", jet_of(HolmesMow(E, nu, beta)),
       [=](double s) {
         return H / 2 * (s - 1 / s) * std::pow(s, -2 * beta) * std::exp(beta * (s * s - 1));
       },
       [=](double s) {
         const double a1 = beta * (2 * mu - lambda) / H, a2 = beta * lambda / H;
         const auto side = [&](double t) {
           return a1 * t * t + a2 * t * t * (s * s + t * t) - beta;
         };
         const double t = root(side, 0.1, 10), ts = t * t;
         const double Q = a1 * (s * s + 2 * ts - 3) + a2 * (2 * s * s * ts + ts * ts - 3) -
                          2 * beta * std::log(s * ts);
         return H / (4 * beta) * std::exp(Q) * 2 * (a1 * s + 2 * a2 * s * ts - beta / s);
       }});
  return laws;
}

TEST(ClosedForm, CoupledLawsHaveTheirConfinedAndTheirUniaxialStress) {
  for (const Coupled& law : coupled_laws()) {
    for (const double s : {0.6, 0.7, 0.9, 0.99, 1.1, 1.3, 1.6}) {
      const double confined = law.law(Vec3(s, 1, 1).asDiagonal()).gradient(0, 0);
      EXPECT_NEAR(confined, law.confined(s), 1e-12 * (2e4 + std::abs(confined))) << law.name << s;
      const double t = free_side(law.law, s);
      const Mat3 P = law.law(Vec3(s, t, t).asDiagonal()).gradient;
      EXPECT_NEAR(P(1, 1), 0, 1e-9) << law.name << s;
      EXPECT_NEAR(P(0, 0), law.free(s), 1e-10 * 2e4) << law.name << s;
    }
  }
}

// The stress of Saint-Venant and Kirchhoff stops growing where the law ends.
TEST(ClosedForm, StVenantKirchhoffEndsWhereItWouldSoften) {
  const StVenantKirchhoff law(2e4, 0.3);
  const double end = 1 / std::sqrt(3.0);
  const auto stiffness = [&](double s) { return law.tangent(Vec3(s, 1, 1).asDiagonal())(0, 0); };
  EXPECT_GT(stiffness(end + 1e-6), 0);
  EXPECT_LT(stiffness(end + 1e-6), 1e-5 * stiffness(1));
  EXPECT_TRUE(std::isnan(stiffness(end - 1e-6)));
}

// Q = β (s² − 1) − 2β ln s passes 100 at s = 4.1 for β = 7: energy, stress and stiffness go on
// without a jump.
TEST(ClosedForm, HolmesMowGoesOnAsAQuadraticBeyondItsLargestExponent) {
  const double E = 2e4, nu = 0.2, beta = 7;
  const HolmesMow law(E, nu, beta);
  const auto [mu, lambda] = lame_parameters(E, nu);
  const double half_c = (lambda + 2 * mu) / (4 * beta), largest = std::exp(100.0);
  const double border =
      root([&](double s) { return beta * (s * s - 1) - 2 * beta * std::log(s) - 100; }, 1.5, 10);
  for (const double s : {border + 1e-9, 4.5, 8.0}) {
    const double d = beta * (s * s - 1) - 2 * beta * std::log(s) - 100;
    ASSERT_GT(d, 0);
    const Mat3 F = Vec3(s, 1, 1).asDiagonal();
    EXPECT_NEAR(law.energy_density(F) / (half_c * (largest * (1 + d + d * d / 2) - 1)), 1, 1e-11);
    const double slope = beta * (2 * s - 2 / s);
    EXPECT_NEAR(law.first_piola(F)(0, 0) / (half_c * largest * (1 + d) * slope), 1, 1e-11);
  }
}

}  // namespace articular::fem::closed_form_test
