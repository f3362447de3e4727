#pragma once

#include "fem/material/dilatation.hpp"
#include "fem/material/material.hpp"

namespace articular::fem {

/// A material whose volumetric energy can be taken from it,
///
///   Ψ(F) = Ψ_d(F) + κ/2 Θ(F)²,
///
/// as elements for nearly incompressible tissue do: they take Θ from more than one tetrahedron.
/// Ψ_d is all the rest, which for some materials depends on the volume too.
template <class M>
concept Split = Hyperelastic<M> && DilatationMeasure<typename M::Dilatation> &&
    requires(const M& m) {
  { m.bulk_modulus() } -> std::same_as<double>;   // κ [Pa]
  { m.shear_modulus() } -> std::same_as<double>;  // μ [Pa], at small strain
  { m.distortion() } -> Hyperelastic;             // Ψ_d
};

/// The sum of the two parts. The distortion has a shear_modulus() [Pa] too.
template <Hyperelastic Distortion, DilatationMeasure Theta>
class SplitMaterial {
 public:
  using Dilatation = Theta;

  /// @param kappa  bulk modulus [Pa], > 0
  SplitMaterial(const Distortion& distortion, double kappa)
      : distortion_(distortion), kappa_(checked_positive(kappa, "bulk modulus", "Pa")) {}

  double bulk_modulus() const { return kappa_; }
  double shear_modulus() const { return distortion_.shear_modulus(); }
  const Distortion& distortion() const { return distortion_; }

  double energy_density(const Mat3& F) const {
    const double theta = Theta::value(F);
    return distortion_.energy_density(F) + 0.5 * kappa_ * theta * theta;
  }
  Mat3 first_piola(const Mat3& F) const {
    return distortion_.first_piola(F) + kappa_ * Theta::value(F) * Theta::gradient(F);
  }
  Mat9 tangent(const Mat3& F) const {
    const Vec9 g = Theta::gradient(F).reshaped();
    return distortion_.tangent(F) + kappa_ * g * g.transpose() +
           kappa_ * Theta::value(F) * Theta::hessian(F);
  }

 private:
  Distortion distortion_;
  double kappa_;  // [Pa]
};

}  // namespace articular::fem
