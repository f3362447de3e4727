#pragma once

#include "fem/material/isochoric.hpp"
#include "fem/material/split_material.hpp"

namespace articular::fem {

/// Skin [Veronda 1970]:
///
///   Ψ_d = c1 (exp(c2 (Ī1 − 3)) − 1) − c1 c2/2 (Ī2 − 3)
///
/// Shear modulus at small strain: c1 c2. Never negative for c2 ≥ 1/3 (as Ī2 ≤ Ī1²/3), which all
/// published constants are far above; for a smaller c2 the second term may win for a while.
///
/// Where the exponent passes 100 (c2 = 10: a stretch of 3.6) the exponential goes on as its
/// quadratic, without a jump in the stiffness: far outside of what tissue bears, but a trial step
/// of a solver gets numbers and not infinity.
///
/// [Veronda 1970] Veronda, Westmann. Mechanical characterization of skin: finite deformations.
///                J. Biomech. 3.
class IsochoricVerondaWestmann {
 public:
  /// @param c1  [Pa], > 0
  /// @param c2  [-], > 0
  IsochoricVerondaWestmann(double c1, double c2)
      : c1_(checked_positive(c1, "c1", "Pa")), c2_(checked_positive(c2, "c2", "(no unit)")) {}

  double shear_modulus() const { return c1_ * c2_; }  // [Pa]

  double energy_density(const Mat3& F) const {
    const double a = std::pow(F.determinant(), -2.0 / 3);
    const double x = c2_ * (a * F.squaredNorm() - 3);
    const double I2 = a * a * cofactor(F).squaredNorm();
    const double d = x - kLargestExponent;
    const double exponential_minus_one =
        d <= 0 ? std::expm1(x) : exponential(kLargestExponent) * (1 + d + 0.5 * d * d) - 1;
    return c1_ * (exponential_minus_one - 0.5 * c2_ * (I2 - 3));
  }

  Mat3 first_piola(const Mat3& F) const {
    const double J = F.determinant(), a = std::pow(J, -2.0 / 3), I1 = F.squaredNorm();
    const Mat3 C = cofactor(F);
    const Vec9 dI2 = cofactor_derivative(F) * C.reshaped();
    const double slope = exponential_slope(c2_ * (a * I1 - 3));
    return c1_ * c2_ *
           (2 * a * slope * (F - I1 / (3 * J) * C) -
            a * a * (dI2.reshaped(3, 3) - 2 * C.squaredNorm() / (3 * J) * C));
  }

  Mat9 tangent(const Mat3& F) const {
    const Jet I1 = first_isochoric_invariant(F);
    const double x = c2_ * (I1.value - 3);
    const double curvature = std::exp(std::fmin(x, kLargestExponent));
    return c1_ * c2_ *
           (composed(I1, 0, exponential_slope(x), c2_ * curvature).hessian -
            0.5 * second_isochoric_invariant(F).hessian);
  }

 private:
  static constexpr double kLargestExponent = 100;  // [-]

  static double exponential(double x) { return std::exp(x); }
  /// d/dx of exp(x) and of the quadratic that continues it.
  static double exponential_slope(double x) {
    const double d = x - kLargestExponent;
    return d <= 0 ? std::exp(x) : std::exp(kLargestExponent) * (1 + d);
  }

  double c1_, c2_;  // [Pa], [-]
};

/// With κ/2 (J − 1)² or κ/2 (ln J)².
template <DilatationMeasure Theta = VolumeChange>
class VerondaWestmann : public SplitMaterial<IsochoricVerondaWestmann, Theta> {
 public:
  /// @param c1, kappa  [Pa], > 0
  /// @param c2         [-], > 0
  /// @throws std::invalid_argument where one is out of range
  VerondaWestmann(double c1, double c2, double kappa)
      : SplitMaterial<IsochoricVerondaWestmann, Theta>({c1, c2}, kappa) {}
};
static_assert(Split<VerondaWestmann<>>);

}  // namespace articular::fem
