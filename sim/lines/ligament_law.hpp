#pragma once

#include "sim/lines/muscle_law.hpp"

namespace articular::sim {

/// Tension of a linear, tension-only band: k (l − l0) for l > l0. Slope with respect to l.
ValueSlope linear_ligament(double length, double slack_length, double stiffness);
double linear_ligament_energy(double length, double slack_length, double stiffness);

/// Blankevoort's law (fem::CrimpedFibre) with strain e = l/l0 − 1, and a stiffness that is force
/// per unit strain [N].
ValueSlope blankevoort_ligament(double length, double slack_length, double stiffness,
                                double toe_strain);
double blankevoort_ligament_energy(double length, double slack_length, double stiffness,
                                   double toe_strain);

/// A band's damper [N]: c l̇ while it stretches, but no more than its elastic tension, so that the
/// force does not jump when the band becomes taut: over a jump there may be no state at which an
/// implicit step could end.
struct Damper {
  double force = 0;
  double by_length = 0;  // [N/m]
  double by_rate = 0;    // [N s/m]
};
/// @param rate  l̇ [m/s]; damping  c [N s/m]
Damper ligament_damper(const ValueSlope& elastic, double rate, double damping);

}  // namespace articular::sim
