#pragma once

#include "fem/material/batch_law.hpp"
#include "fem/material/split_material.hpp"

namespace articular::fem {

/// Compressible neo-Hookean solid with ln J [Bonet 2008, ch. 6.4.3]:
///
///   Ψ = μ/2 (I1 − 3) − μ ln J + λ/2 (ln J)²
///   P = μ F + (λ ln J − μ)/J ∂J/∂F
///
/// Other programs call it "neo-Hookean". Defined for J > 0, where the energy of a crushed element
/// grows without bound; not a number elsewhere. Nowhere negative for ν ≥ 0.
///
/// [Bonet 2008] Bonet, Wood. Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed.
class CoupledNeoHookean {
 public:
  using Dilatation = LogVolumeChange;

  /// @param E   Young's modulus [Pa], > 0
  /// @param nu  Poisson's ratio [-], in (-1, 0.5)
  /// @throws std::invalid_argument outside those ranges
  CoupledNeoHookean(double E, double nu) : lame_(lame_parameters(E, nu)) {}

  double shear_modulus() const { return lame_.mu; }                 // [Pa]
  double bulk_modulus() const { return fem::bulk_modulus(lame_); }  // [Pa]
  /// Ψ_d = μ/2 (I1 − 3) − μ ln J − μ/3 (ln J)²: the law of bulk modulus 0
  CoupledNeoHookean distortion() const { return CoupledNeoHookean(without_bulk_modulus(lame_.mu)); }

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3& F) const;

  BatchLaw batch_law() const { return {BatchLaw::Kind::CoupledNeoHookean, lame_.mu, lame_.lambda}; }
  /// Of a distortion().
  SplitBatchLaw split_batch_law() const {
    return {.distortion = SplitBatchLaw::Distortion::CoupledNeoHookean,
            .c = {lame_.mu, lame_.lambda, 0}};
  }

 private:
  explicit CoupledNeoHookean(const Lame& lame) : lame_(lame) {}

  Lame lame_;
};
static_assert(Split<CoupledNeoHookean> && Batched<CoupledNeoHookean>);

}  // namespace articular::fem
