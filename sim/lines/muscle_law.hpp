#pragma once

#include "fem/material/force_velocity.hpp"
#include "sim/scenario/scenario.hpp"

namespace articular::sim {

using fem::ValueSlope;

/// Of the lengthening rate in vmax, as fibres of tissue have it.
using fem::force_velocity;

/// Tendon of a line past the end of its path at a time [m].
double length_beyond(const Muscle& muscle, double t);

/// Active force–length factor of a line of length l [m] at n = (l − r l_opt) / (l_opt (1 − r)), the
/// relative length of its fibres: the tendon of length r l_opt does not stretch. Slope [1/m].
///
///   Cosine    ½(1 + cos 2πn) for 0.5 < n < 1.5, else 0 [Peck 2000, Arch Oral Biol 45:963]
///   Parabola  1 − 4(1 − n)² for 0.6 < n < 1.4 with feet from 0.4 and to 1.6, as fibres of tissue
///             have it (fem::MuscleFibre) [Blemker 2005, J Biomech 38:657]
ValueSlope active_force_length(Muscle::ForceLengthCurve curve, double length, double optimal_length,
                               double tendon_ratio);

/// Passive factor: 0 up to the optimal length, linear to 1 at max_ratio times it, 1 beyond. [Peck
/// 2000]
ValueSlope passive_force_length(double length, double optimal_length, double max_ratio);

/// Energy behind the passive factor: ∫ p dl [m].
double passive_energy_length(double length, double optimal_length, double max_ratio);

}  // namespace articular::sim
