#pragma once

#include "fem/material/fibre.hpp"

namespace articular::fem {

/// Crimped collagen that pulls only when stretched [Weiss 1996, eq. 7.2]:
///
///   λ dW/dλ = 0                        λ ≤ 1
///             c3 (exp(c4 (λ − 1)) − 1) 1 < λ < λ*
///             c5 λ + c6                λ ≥ λ*, c6 such that the stress has no jump
///
/// The stiffness jumps where fibres become taut (λ = 1: from 0 to c3 c4) and, with most published
/// constants, at λ*.
class ToeLinearFibre {
 public:
  static constexpr bool kFeelsVolume = false;

  struct Constants {
    double c3;       // [Pa], > 0
    double c4;       // [-], > 0, with c4 λ* < 700 (its exponential has to be a number)
    double c5;       // [Pa], > 0
    double toe_end;  // λ* [-], > 1, the stretch itself
  };
  /// @throws std::invalid_argument naming a constant that is out of range
  explicit ToeLinearFibre(const Constants& c);

  double energy(double stretch, double activation) const;  // none feels the activation
  double tension(double stretch, double activation) const;
  double stiffness(double stretch, double activation) const;
  double cauchy_stress(double stretch) const;  // λ dW/dλ [Pa]
  double toe_end() const { return c_.toe_end; }

 private:
  double stress_slope(double stretch) const;
  // ∫ c3 (exp(c4 (λ − 1)) − 1)/λ dλ from 1, with the exponential integral Ei.
  double toe_energy(double stretch) const;

  Constants c_;
  double c6_;  // [Pa]
};
static_assert(FibreLaw<ToeLinearFibre>);

}  // namespace articular::fem
