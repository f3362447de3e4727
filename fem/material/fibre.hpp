#pragma once

#include "fem/material/batch_law.hpp"
#include "fem/material/fibre_invariants.hpp"
#include "fem/material/split_material.hpp"

namespace articular::fem {

/// The energy W of fibres at a stretch λ > 0 and an activation in [0, 1]. At a constant activation
/// it is elastic; a change of it adds or takes energy, as muscle does. Cauchy stress of the fibre:
/// λ dW/dλ.
///
/// kFeelsVolume says which stretch: λ = |F a0|, or λ̄ without the change of volume. Incompressible
/// tissue does not tell them apart. But a tension T of λ̄ is a stress T (a aᵀ − I/3), whose second
/// part a pressure of T/3 has to balance. Elements that have distortion and pressure on different
/// domains don't balance it wave by wave, and where T is active (it has no stiffness) and some
/// times the shear modulus they fold.
template <class L>
concept FibreLaw = requires(const L& law, double stretch, double activation) {
  { L::kFeelsVolume } -> std::convertible_to<bool>;
  { law.energy(stretch, activation) } -> std::same_as<double>;     // W [J/m³]
  { law.tension(stretch, activation) } -> std::same_as<double>;    // dW/dλ [Pa], per rest area
  { law.stiffness(stretch, activation) } -> std::same_as<double>;  // d²W/dλ² [Pa]
};

/// Refers to the law.
template <FibreLaw L>
FibreCurve fibre_curve(const L& law) {
  return {.law = &law,
          .energy =
              [](const void* any, double stretch, double activation) {
                return static_cast<const L*>(any)->energy(stretch, activation);
              },
          .tension =
              [](const void* any, double stretch, double activation) {
                return static_cast<const L*>(any)->tension(stretch, activation);
              },
          .stiffness =
              [](const void* any, double stretch, double activation) {
                return static_cast<const L*>(any)->stiffness(stretch, activation);
              }};
}

/// A material whose elements each have a direction of fibres, and which may pull along it.
template <class M>
concept Fibred = requires(const M& m, const Vec3& a0, double activation) {
  /// The law of an element. @param a0  see FibreDirections; @param activation  in [0, 1]
  { m.along(a0, activation) } -> Split;
};

/// The law of element e: the material, or what it is along the fibres of e.
template <class M>
decltype(auto) element_law(const M& material, [[maybe_unused]] const FibreDirections& fibres,
                           [[maybe_unused]] Eigen::Index e, [[maybe_unused]] double activation) {
  if constexpr (Fibred<M>) {
    return material.along(fibres.col(e), activation);
  } else {
    return (material);
  }
}

/// Ψ_d = Ψ_ground + ρ W: a ground substance with fibres along a0 [Weiss 1996], ρ of them where the
/// law has one. Defined for J > 0.
template <Hyperelastic Ground, FibreLaw Law>
class Reinforced {
 public:
  /// @param a0  along the fibres at rest; of length ρ
  Reinforced(const Ground& ground, const Law& law, const Vec3& a0, double activation)
      : ground_(ground),
        law_(law),
        density_(a0.norm()),
        a0_(a0 / density_),
        activation_(activation) {}

  double shear_modulus() const { return ground_.shear_modulus(); }  // [Pa]

  double energy_density(const Mat3& F) const {
    return ground_.energy_density(F) + density_ * law_.energy(stretch(F), activation_);
  }
  Mat3 first_piola(const Mat3& F) const {
    return ground_.first_piola(F) +
           density_ * law_.tension(stretch(F), activation_) * stretch_gradient(F);
  }
  Mat9 tangent(const Mat3& F) const {
    const Invariants I(F, a0_);
    InvariantSlopes energy;
    add_slopes(I, energy);
    return fem::tangent(I, energy);
  }
  /// @param I  of the same fibre
  void add_slopes(const Invariants& I, InvariantSlopes& energy) const {
    ground_.add_slopes(I, energy);
    const IsochoricInvariant stretch =
        Law::kFeelsVolume ? IsochoricInvariant(I, kI4, 0.5, 0) : isochoric_stretch(I);
    energy.add(stretch.slopes, density_ * law_.tension(stretch.value, activation_),
               density_ * law_.stiffness(stretch.value, activation_));
  }

 private:
  double stretch(const Mat3& F) const {
    return Law::kFeelsVolume ? fibre_stretch(F, a0_) : isochoric_fibre_stretch(F, a0_);
  }
  Mat3 stretch_gradient(const Mat3& F) const {
    return Law::kFeelsVolume ? fibre_stretch_gradient(F, a0_)
                             : isochoric_fibre_stretch_gradient(F, a0_);
  }

  Ground ground_;
  Law law_;
  double density_;     // ρ [-]
  Vec3 a0_;            // unit vector
  double activation_;  // [-]
};

}  // namespace articular::fem
