#pragma once

#include "fem/material/batch_law.hpp"
#include "fem/material/split_material.hpp"

namespace articular::fem {

/// Stable neo-Hookean solid [Smith 2018], without the barrier term:
///
///   Ψ(F) = μ/2 (tr FᵀF − 3) + λ/2 ((J − α)² − (1 − α)²),   α = 1 + μ/λ
///   P(F) = μ F + λ (J − α) ∂J/∂F
///
/// Defined for every F, inverted ones (J ≤ 0) included. λ is the Lamé constant plus μ:
/// with that shift the small-strain limit is Hooke's law for the given E and ν.
///
/// Without the barrier F = 0 is a second minimum: under F = s I the energy falls towards it where
/// s + s² + s³ < 1 − 2ν. An element that is crushed in all directions at once to less than 0.09 of
/// its length at ν = 0.45, or 0.29 at ν = 0.3, does not return.
///
/// [Smith 2018] Smith, De Goes, Kim. Stable Neo-Hookean Flesh Simulation. ACM TOG 37(2).
class NeoHookean {
 public:
  using Dilatation = VolumeChange;

  /// @param E   Young's modulus [Pa], > 0
  /// @param nu  Poisson's ratio [-], in (-1, 0.5)
  /// @throws std::invalid_argument outside those ranges
  NeoHookean(double E, double nu) : NeoHookean(lame_parameters(E, nu)) {}

  double shear_modulus() const { return mu_; }               // [Pa]
  double bulk_modulus() const { return lambda_ - mu_ / 3; }  // [Pa]
  /// Ψ_d = μ/2 (tr FᵀF − 3) − μ (J − 1) + μ/6 (J − 1)²: the law of bulk modulus 0
  NeoHookean distortion() const { return NeoHookean(without_bulk_modulus(mu_)); }

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3& F) const;

  BatchLaw batch_law() const { return {BatchLaw::Kind::NeoHookean, mu_, lambda_}; }
  /// Of a distortion().
  SplitBatchLaw split_batch_law() const {
    return {.distortion = SplitBatchLaw::Distortion::NeoHookean, .c = {mu_, lambda_, 0}};
  }

 private:
  explicit NeoHookean(const Lame& lame)
      : mu_(lame.mu), lambda_(lame.lambda + lame.mu), alpha_(1 + mu_ / lambda_) {}

  double mu_, lambda_;  // [Pa]
  double alpha_;        // [-]
};
static_assert(Split<NeoHookean> && Batched<NeoHookean>);

}  // namespace articular::fem
