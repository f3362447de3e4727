#pragma once

#include <cmath>

#include "fem/material/fibre.hpp"

namespace articular::fem {

/// Crimped collagen that pulls only when stretched [Weiss 1996, eq. 7.2], and an active stress:
///
///   λ dW/dλ = a σ_a +  0                        λ ≤ 1
///                      c3 (exp(c4 (λ − 1)) − 1) 1 < λ < λ*
///                      c5 λ + c6                λ ≥ λ*, c6 such that the stress has no jump
///
/// The stiffness jumps where fibres become taut (λ = 1: from 0 to c3 c4) and, with most published
/// constants, at λ*. The active Cauchy stress does not depend on the stretch; its energy a σ_a ln λ
/// is negative where λ < 1.
class ToeLinearFibre {
 public:
  struct Constants {
    double c3;                 // [Pa], > 0
    double c4;                 // [-], > 0, with c4 λ* < 700 (its exponential has to be a number)
    double c5;                 // [Pa], > 0
    double toe_end;            // λ* [-], > 1, the stretch itself
    double active_stress = 0;  // σ_a [Pa], at full activation, not negative
  };
  /// @throws std::invalid_argument naming a constant that is out of range
  explicit ToeLinearFibre(const Constants& c);

  double energy(double stretch, double activation) const {
    const double active = activation * c_.active_stress * std::log(stretch);
    if (stretch <= 1) return active;
    if (stretch < c_.toe_end) return active + toe_energy(stretch);
    return active + toe_energy(c_.toe_end) + c_.c5 * (stretch - c_.toe_end) +
           c6_ * std::log(stretch / c_.toe_end);
  }
  double tension(double stretch, double activation) const {
    return cauchy_stress(stretch, activation) / stretch;
  }
  double stiffness(double stretch, double activation) const {
    return (stress_slope(stretch) - tension(stretch, activation)) / stretch;
  }
  /// λ dW/dλ [Pa]
  double cauchy_stress(double stretch, double activation) const {
    const double active = activation * c_.active_stress;
    if (stretch <= 1) return active;
    if (stretch < c_.toe_end) return active + c_.c3 * std::expm1(c_.c4 * (stretch - 1));
    return active + c_.c5 * stretch + c6_;
  }

 private:
  double stress_slope(double stretch) const {
    if (stretch <= 1) return 0;
    if (stretch < c_.toe_end) return c_.c3 * c_.c4 * std::exp(c_.c4 * (stretch - 1));
    return c_.c5;
  }
  // ∫ c3 (exp(c4 (λ − 1)) − 1)/λ dλ from 1, with the exponential integral Ei.
  double toe_energy(double stretch) const {
    const double difference = std::expint(c_.c4 * stretch) - std::expint(c_.c4);
    return c_.c3 * (std::exp(-c_.c4) * difference - std::log(stretch));
  }

  Constants c_;
  double c6_;  // [Pa]
};
static_assert(FibreLaw<ToeLinearFibre>);

}  // namespace articular::fem
