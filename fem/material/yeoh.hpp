#pragma once

#include "fem/material/batch_law.hpp"
#include "fem/material/split_material.hpp"

namespace articular::fem {

/// Ψ_d = c10 (Ī1 − 3) + c20 (Ī1 − 3)², the first two terms of [Yeoh 1993], for tongue and face.
/// Shear modulus at small strain: 2 c10.
///
/// [Yeoh 1993] Yeoh. Some forms of the strain energy function for rubber. Rubber Chem. Technol. 66.
class IsochoricYeoh {
 public:
  /// @param c10  [Pa], > 0
  /// @param c20  [Pa], not negative
  IsochoricYeoh(double c10, double c20)
      : c10_(checked_positive(c10, "c10", "Pa")), c20_(checked_not_negative(c20, "c20", "Pa")) {}

  double shear_modulus() const { return 2 * c10_; }  // [Pa]

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3& F) const;

  SplitBatchLaw split_batch_law() const {
    return {.distortion = SplitBatchLaw::Distortion::Polynomial, .c = {c10_, c20_, 0}};
  }

 private:
  double c10_, c20_;  // [Pa]
};

/// With κ/2 (J − 1)² or κ/2 (ln J)².
template <DilatationMeasure Theta = VolumeChange>
class Yeoh : public SplitMaterial<IsochoricYeoh, Theta> {
 public:
  /// @param c10, c20, kappa  [Pa]
  /// @throws std::invalid_argument where one is out of range
  Yeoh(double c10, double c20, double kappa)
      : SplitMaterial<IsochoricYeoh, Theta>({c10, c20}, kappa) {}
};
static_assert(Split<Yeoh<>>);

}  // namespace articular::fem
