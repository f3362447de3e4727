#pragma once

#include <optional>

#include "fem/material/fibre.hpp"
#include "fem/material/force_velocity.hpp"

namespace articular::fem {

/// Passive and active tension of muscle fibres [Blemker 2005], at the length n relative to that of
/// the largest active force (the isometric σ_max):
///
///   dW/dλ = σ_max/λ_ofl (f_p(n) + a f_a(n)),   n = (λ/λ_ofl − r)/(1 − r)
///
/// r is the part of the line of fibres that is tendon and does not stretch, as in the lines of sim:
/// muscle whose fibres end at aponeuroses, spread out evenly. It is not in the paper; without it
/// n = λ/λ_ofl, and the Cauchy stress λ dW/dλ is σ_max (f_p + a f_a) n. The curves are
///
///   f_p = 0 up to n = 1, P1 (exp(P2 (n − 1)) − 1) up to n*, its tangent line beyond
///   f_a = 9 (n − 0.4)² from 0.4 to 0.6, 1 − 4 (1 − n)² to 1.4, 9 (n − 1.6)² to 1.6, 0 elsewhere
///
/// Beyond n = 1 a fibre that pulls less the longer it is is unstable where nothing else holds it:
/// one part shortens and draws the other out. Muscle is stretched and does not [Rassier 1999].
/// Without a descending limb f_a stays 1 beyond n = 1.
///
/// With a largest speed of shortening v, in optimal lengths per second, the active part is
/// a f_a f_v of Hill's curve (force_velocity.hpp), of the rate ṅ/v. The energy and the tension
/// below are those of f_v = 1; drag() is the rest, which no energy has.
///
/// As published f_a has corners at 0.6 and 1.4 (slopes 3.6 and 3.2), so that the stiffness jumps.
/// The energy of the active part is counted from n = 0.4: never negative, not 0 at rest.
///
/// [Blemker 2005] Blemker, Pinsky, Delp. A 3D model of muscle reveals the causes of nonuniform
///                strains in the biceps brachii. J. Biomech. 38.
/// [Rassier 1999] Rassier, MacIntosh, Herzog. Length dependence of active force production in
///                skeletal muscle. J. Appl. Physiol. 86.
class MuscleFibre {
 public:
  static constexpr bool kFeelsVolume = true;  // the paper has λ̄

  struct Constants {
    double max_stress = 0.3e6;   // σ_max [Pa], > 0
    double p1 = 0.05, p2 = 6.6;  // P1, P2 [-], > 0
    double toe_end = 1.4;  // n* [-], > 1; times optimal_stretch it is the λ* of [Blemker 2005]
    double optimal_stretch = 1;  // λ_ofl [-], >= 1: no passive tension at rest
    double tendon_ratio = 0;     // r [-], from 0 to below 1
    bool descending_limb = true;
    std::optional<double> max_velocity = {};  // v [1/s], > 0; none: any speed costs no force
  };
  /// @throws std::invalid_argument naming a constant that is out of range
  explicit MuscleFibre(const Constants& c);

  double energy(double stretch, double activation) const;
  double tension(double stretch, double activation) const;
  double stiffness(double stretch, double activation) const;

  bool has_drag() const { return c_.max_velocity.has_value(); }
  /// What dW/dλ lacks at a rate λ̇ [1/s], pull (f_v(w) − 1).
  struct Drag {
    double pull = 0;      // σ_max/λ_ofl a f_a [Pa]
    double per_rate = 0;  // w/λ̇ [s]
  };
  Drag drag(double stretch, double activation) const;

  double max_stress() const { return c_.max_stress; }  // [Pa]

  /// f_a, its slope and its integral from 0
  static double active(double n);
  static double active_slope(double n);
  static double active_integral(double n);

 private:
  double relative_length(double stretch) const;  // n
  double passive(double n) const;
  double passive_slope(double n) const;
  double passive_integral(double n) const;
  double active_length(double n) const;  // where on the curve fibres of length n are

  Constants c_;
  double end_slope_;  // of f_p at n* [-]
};
static_assert(FibreLaw<MuscleFibre>);

}  // namespace articular::fem
