#pragma once

#include "fem/material/fibre_shear.hpp"
#include "fem/material/muscle_fibre.hpp"

namespace articular::fem {

/// Skeletal muscle in three dimensions [Blemker 2005]: tension along the fibres, passive and
/// active (MuscleFibre), shear along and across them (FibreShear) and κ/2 Θ² (the paper has
/// Θ = ln J):
///
///   Ψ = G1 B1² + G2 B2² + W(λ, a) + κ/2 Θ²  (+ (c10 + a c10a) (Ī1 − 3))
///
/// The paper has W(λ̄): see FibreLaw for why fibres feel the volume here.
/// c10 is an addition: it gives slack fibres (a passive muscle that is shortened) a stiffness. So
/// is c10a: muscle is the stiffer to shear the harder it contracts.
///
/// [Blemker 2005] Blemker, Pinsky, Delp. A 3D model of muscle reveals the causes of nonuniform
///                strains in the biceps brachii. J. Biomech. 38.
template <DilatationMeasure Theta = LogVolumeChange>
class BlemkerMuscle {
 public:
  using Dilatation = Theta;

  struct Constants {
    double G1 = 500, G2 = 500;  // shear along and across the fibre [Pa], > 0
    double c10 = 0;             // isotropic ground substance [Pa], not negative
    double active_c10 = 0;      // what full activation adds to it [Pa], not negative
    double kappa = 1e7;         // bulk modulus [Pa], > 0
  };
  /// @throws std::invalid_argument naming a constant that is out of range
  BlemkerMuscle(const MuscleFibre& fibre, const Constants& constants)
      : fibre_(fibre), c_(constants) {
    checked_positive(c_.G1, "G1", "Pa");
    checked_positive(c_.G2, "G2", "Pa");
    checked_not_negative(c_.c10, "c10", "Pa");
    checked_not_negative(c_.active_c10, "c10 of activation", "Pa");
    checked_positive(c_.kappa, "bulk modulus", "Pa");
  }

  const MuscleFibre& fibre() const { return fibre_; }
  double active_stress() const { return fibre_.max_stress(); }         // [Pa]
  double bulk_modulus() const { return c_.kappa; }                     // [Pa]
  double shear_modulus() const { return c_.G1 + c_.G2 + 2 * c_.c10; }  // [Pa], mean of two

  using Local = SplitMaterial<Reinforced<FibreShear, MuscleFibre>, Theta>;
  Local along(const Vec3& a0, double activation) const {
    const FibreShear ground(c_.G1, c_.G2, c10(activation), a0.normalized());
    return {{ground, fibre_, a0, activation}, c_.kappa};
  }

  /// At a constant activation in [0, 1]; refers to this.
  SplitBatchLaw fibred_batch_law(double activation) const {
    return {.distortion = SplitBatchLaw::Distortion::Fibred,
            .c = {c10(activation), 0, 0},
            .fibres = {.activation = activation,
                       .shear_along = c_.G1,
                       .shear_across = c_.G2,
                       .of_stretch = fibre_curve(fibre_)}};
  }

 private:
  double c10(double activation) const { return c_.c10 + activation * c_.active_c10; }

  MuscleFibre fibre_;
  Constants c_;
};
static_assert(Fibred<BlemkerMuscle<>>);

}  // namespace articular::fem
