#pragma once

#include <optional>

#include "fem/material/fibre.hpp"
#include "fem/material/force_length.hpp"

namespace articular::fem {

/// An active stress of fibres whose passive part is another law:
///
///   dW/dλ = a σ_a           a force per area at rest, whatever the length
///   λ dW/dλ = a σ_a f(λ)    with a ForceLength, as published
///
/// A constant λ dW/dλ would pull less the longer the fibre is. Tissue does not bear that where σ_a
/// is some times the shear modulus: one part of it shortens and draws the other out.
/// Energies are counted from λ = 0: never negative, not 0 at rest.
class ActiveFibre {
 public:
  static constexpr bool kFeelsVolume = true;

  struct Constants {
    double stress = 0;  // σ_a [Pa], at full activation, not negative
    std::optional<ForceLength> force_length = {};
  };
  ActiveFibre() = default;  // never pulls
  /// @throws std::invalid_argument when the stress is negative
  explicit ActiveFibre(const Constants& c);

  double max_stress() const { return c_.stress; }  // [Pa]
  double energy(double stretch, double activation) const;
  double tension(double stretch, double activation) const;
  double stiffness(double stretch, double activation) const;

 private:
  Constants c_;
};
static_assert(FibreLaw<ActiveFibre>);

}  // namespace articular::fem
