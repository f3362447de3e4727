#pragma once

#include "fem/material/split_material.hpp"

namespace articular::fem {

/// Hooke's law on the small strain tensor:
///
///   ε = (F + Fᵀ)/2 − I,   Ψ = μ ε:ε + λ/2 (tr ε)²,   P = σ = 2μ ε + λ tr(ε) I
///
/// For small rotations only: a finite rotation strains it.
class Linear {
 public:
  using Dilatation = SmallDilatation;

  /// @param E   Young's modulus [Pa], > 0
  /// @param nu  Poisson's ratio [-], in (-1, 0.5)
  /// @throws std::invalid_argument outside those ranges
  Linear(double E, double nu) : lame_(lame_parameters(E, nu)) {}

  double shear_modulus() const { return lame_.mu; }                 // [Pa]
  double bulk_modulus() const { return fem::bulk_modulus(lame_); }  // [Pa]
  /// Ψ_d = μ dev ε : dev ε
  Linear distortion() const { return Linear(without_bulk_modulus(lame_.mu)); }

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3&) const;

  /// In the small-strain theory all stresses are one: P Fᵀ/J would not even be symmetric.
  Mat3 cauchy_stress(const Mat3& F) const { return first_piola(F); }

 private:
  explicit Linear(const Lame& lame) : lame_(lame) {}

  Lame lame_;
};
static_assert(Split<Linear>);

}  // namespace articular::fem
