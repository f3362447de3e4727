#pragma once

#include "fem/material/split_material.hpp"

namespace articular::fem {

/// Saint-Venant–Kirchhoff solid: Hooke's law on the Green–Lagrange strain E = (FᵀF − I)/2
/// [Bonet 2008, ch. 6],
///
///   Ψ = λ/2 tr²E + μ E:E,   S = λ tr(E) I + 2μ E,   P = F S
///
/// It softens in compression. One stretch s with fixed sides, with free sides, and all three alike
/// have stresses in proportion to s (s² − 1), which stop growing at s = 1/√3 and vanish at s = 0;
/// the mirror image of a shape counts as unstrained. So this law ends there: it is no number where
/// J ≤ 0 or a principal stretch is 1/√3 or less, and a solver has to stay away.
///
/// [Bonet 2008] Bonet, Wood. Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed.
class StVenantKirchhoff {
 public:
  using Dilatation = GreenDilatation;

  /// @param E   Young's modulus [Pa], > 0
  /// @param nu  Poisson's ratio [-], in (-1, 0.5)
  /// @throws std::invalid_argument outside those ranges
  StVenantKirchhoff(double E, double nu) : lame_(lame_parameters(E, nu)) {}

  double shear_modulus() const { return lame_.mu; }                 // [Pa]
  double bulk_modulus() const { return fem::bulk_modulus(lame_); }  // [Pa]
  /// Ψ_d = μ dev E : dev E
  StVenantKirchhoff distortion() const { return StVenantKirchhoff(without_bulk_modulus(lame_.mu)); }

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3& F) const;

 private:
  explicit StVenantKirchhoff(const Lame& lame) : lame_(lame) {}

  Mat3 second_piola(const Mat3& F) const;

  Lame lame_;
};
static_assert(Split<StVenantKirchhoff>);

}  // namespace articular::fem
