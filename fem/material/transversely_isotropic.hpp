#pragma once

#include <optional>

#include "fem/material/active_fibre.hpp"
#include "fem/material/mooney_rivlin.hpp"
#include "fem/material/prestretch.hpp"
#include "fem/material/toe_linear_fibre.hpp"

namespace articular::fem {

/// Ligament, tendon, meniscus [Weiss 1996]: fibres in a Mooney–Rivlin ground substance,
///
///   Ψ = c10 (Ī1 − 3) + c01 (Ī2 − 3) + W(λ̄) + κ/2 Θ²  (+ W_a(λ, a)),
///
/// with the W of ToeLinearFibre. W_a of ActiveFibre is an addition, for tissue that pulls by
/// itself; see FibreLaw for why it feels the volume. At small strain it is isotropic as long as the
/// fibres are slack; taut ones add c3 c4 to the modulus along them: with a stretch ε along the
/// fibre, no change of volume and free sides, σ = (6 (c10 + c01) + c3 c4) ε. Ligaments are taut in
/// the pose that they are drawn in: there Ψ may be that of prestretch.hpp. Defined for J > 0.
///
/// [Weiss 1996] Weiss, Maker, Govindjee. Finite element implementation of incompressible,
///              transversely isotropic hyperelasticity. Comput. Methods Appl. Mech. Eng. 135.
template <DilatationMeasure Theta = VolumeChange>
class TransverselyIsotropic {
 public:
  using Dilatation = Theta;

  /// @param c10, c01    [Pa], not negative, sum > 0
  /// @param kappa       bulk modulus [Pa], > 0
  /// @param prestretch  of the fibres as drawn, by that when the tissue is free; in [0.5, 2]
  /// @throws std::invalid_argument naming a constant that is out of range
  TransverselyIsotropic(double c10, double c01, const ToeLinearFibre& fibre, double kappa,
                        const ActiveFibre& active = {}, double prestretch = 1)
      : ground_(c10, c01),
        fibre_(fibre),
        active_(active),
        kappa_(checked_positive(kappa, "bulk modulus", "Pa")),
        prestretch_(checked_prestretch(prestretch)) {}

  double active_stress() const { return active_.max_stress(); }     // [Pa]
  double bulk_modulus() const { return kappa_; }                    // [Pa]
  double shear_modulus() const { return ground_.shear_modulus(); }  // [Pa]
  double prestretch() const { return prestretch_; }                 // [-]
  double toe_end() const { return fibre_.toe_end(); }               // λ* [-]

  /// At a constant activation in [0, 1]; refers to this. None where the fibres are stretched at
  /// rest.
  std::optional<SplitBatchLaw> fibred_batch_law(double activation) const {
    if (prestretch_ != 1) return std::nullopt;
    SplitBatchLaw law = ground_.split_batch_law();
    law.distortion = SplitBatchLaw::Distortion::Fibred;
    law.fibres = {.activation = activation, .of_isochoric_stretch = fibre_curve(fibre_)};
    if (active_.max_stress() > 0) law.fibres.of_stretch = fibre_curve(active_);
    return law;
  }

  using Passive = Reinforced<IsochoricMooneyRivlin, ToeLinearFibre>;
  using Free = Reinforced<Passive, ActiveFibre>;
  using Local = SplitMaterial<Prestretched<Free>, Theta>;
  Local along(const Vec3& a0, double activation) const {
    const Free free({ground_, fibre_, a0, activation}, active_, a0, activation);
    return {{free, prestretch_gradient(prestretch_, a0.normalized())}, kappa_};
  }

 private:
  IsochoricMooneyRivlin ground_;
  ToeLinearFibre fibre_;
  ActiveFibre active_;
  double kappa_;       // [Pa]
  double prestretch_;  // [-]
};
static_assert(Fibred<TransverselyIsotropic<>>);

}  // namespace articular::fem
