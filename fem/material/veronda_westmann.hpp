#pragma once

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
/// quadratic (bounded_exponential.hpp).
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

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3& F) const;

 private:
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
