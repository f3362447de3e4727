#pragma once

#include "fem/material/batch_law.hpp"
#include "fem/material/invariants.hpp"
#include "fem/material/split_material.hpp"

namespace articular::fem {

/// Ψ_d = c10 (Ī1 − 3) + c01 (Ī2 − 3), the isochoric part of a Mooney–Rivlin solid [Bonet 2008, ch.
/// 6]; with c01 = 0 of a neo-Hookean one. Shear modulus at small strain: 2 (c10 + c01).
///
/// [Bonet 2008] Bonet, Wood. Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed.
class IsochoricMooneyRivlin {
 public:
  /// @param c10, c01  [Pa], not negative, sum > 0
  IsochoricMooneyRivlin(double c10, double c01)
      : c10_(checked_not_negative(c10, "c10", "Pa")), c01_(checked_not_negative(c01, "c01", "Pa")) {
    checked_positive(c10 + c01, "c10 + c01", "Pa");
  }

  double shear_modulus() const { return 2 * (c10_ + c01_); }  // [Pa]

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3& F) const;
  void add_slopes(const Invariants& I, InvariantSlopes& energy) const;

  SplitBatchLaw split_batch_law() const {
    return {.distortion = SplitBatchLaw::Distortion::Polynomial, .c = {c10_, 0, c01_}};
  }

 private:
  double c10_, c01_;  // [Pa]
};

/// With κ/2 (J − 1)² or κ/2 (ln J)².
template <DilatationMeasure Theta = VolumeChange>
class MooneyRivlin : public SplitMaterial<IsochoricMooneyRivlin, Theta> {
 public:
  /// @param c10, c01, kappa  [Pa]
  /// @throws std::invalid_argument where one is out of range
  MooneyRivlin(double c10, double c01, double kappa)
      : SplitMaterial<IsochoricMooneyRivlin, Theta>({c10, c01}, kappa) {}
};
static_assert(Split<MooneyRivlin<>>);

/// The neo-Hookean solid μ/2 (Ī1 − 3) + κ/2 Θ² of Young's modulus [Pa] and Poisson's ratio.
template <DilatationMeasure Theta = VolumeChange>
MooneyRivlin<Theta> isochoric_neo_hookean(double E, double nu) {
  const auto [mu, lambda] = lame_parameters(E, nu);
  return {mu / 2, 0, lambda + 2 * mu / 3};
}

}  // namespace articular::fem
