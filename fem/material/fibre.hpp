#pragma once

#include "fem/material/fibre_invariants.hpp"
#include "fem/material/split_material.hpp"

namespace articular::fem {

/// The energy W of fibres at a stretch λ > 0 and an activation in [0, 1]. At a constant activation
/// it is elastic; a change of it adds or takes energy, as muscle does. Cauchy stress of the fibre:
/// λ dW/dλ.
template <class L>
concept FibreLaw = requires(const L& law, double stretch, double activation) {
  { law.energy(stretch, activation) } -> std::same_as<double>;     // W [J/m³]
  { law.tension(stretch, activation) } -> std::same_as<double>;    // dW/dλ [Pa], per rest area
  { law.stiffness(stretch, activation) } -> std::same_as<double>;  // d²W/dλ² [Pa]
};

/// A material whose elements each have a direction of fibres, and which may pull along it.
template <class M>
concept Fibred = requires(const M& m, const Vec3& a0, double activation) {
  /// The law of an element. @param a0  unit vector at rest; @param activation  in [0, 1]
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

/// Ψ_d = Ψ_ground + W(λ̄): a ground substance with fibres along a0 that feel the stretch without
/// the change of volume [Weiss 1996]. Defined for J > 0.
template <Hyperelastic Ground, FibreLaw Law>
class Reinforced {
 public:
  /// @param a0  unit vector at rest
  Reinforced(const Ground& ground, const Law& law, const Vec3& a0, double activation)
      : ground_(ground), law_(law), a0_(a0), activation_(activation) {}

  double shear_modulus() const { return ground_.shear_modulus(); }  // [Pa]

  double energy_density(const Mat3& F) const {
    return ground_.energy_density(F) + law_.energy(isochoric_fibre_stretch(F, a0_), activation_);
  }
  Mat3 first_piola(const Mat3& F) const {
    const double tension = law_.tension(isochoric_fibre_stretch(F, a0_), activation_);
    return ground_.first_piola(F) + tension * isochoric_fibre_stretch_gradient(F, a0_);
  }
  Mat9 tangent(const Mat3& F) const {
    const Jet stretch = isochoric_fibre_stretch_jet(F, a0_);
    return ground_.tangent(F) + composed(stretch, 0, law_.tension(stretch.value, activation_),
                                         law_.stiffness(stretch.value, activation_))
                                    .hessian;
  }

 private:
  Ground ground_;
  Law law_;
  Vec3 a0_;
  double activation_;  // [-]
};

}  // namespace articular::fem
