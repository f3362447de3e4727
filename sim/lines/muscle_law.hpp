#pragma once

namespace articular::sim {

/// A function's value and derivative.
struct ValueSlope {
  double value = 0, slope = 0;
};

/// Active force–length factor of Peck: ½(1 + cos 2πn) for 0.5 < n < 1.5, else 0, with
/// n = (l − r l_opt) / (l_opt (1 − r)): the tendon of length r l_opt does not stretch.
/// Slope with respect to l. [Peck 2000, Arch Oral Biol 45:963]
ValueSlope active_force_length(double length, double optimal_length, double tendon_ratio);

/// Passive factor: 0 up to the optimal length, linear to 1 at max_ratio times it, 1 beyond. [Peck
/// 2000]
ValueSlope passive_force_length(double length, double optimal_length, double max_ratio);

/// Energy behind the passive factor: ∫ p dl [m].
double passive_energy_length(double length, double optimal_length, double max_ratio);

/// Force–velocity factor of the normalised lengthening rate w = l̇ / (vmax l_opt): shortening (w <
/// 0) Hill's hyperbola (1 + w)/(1 − 4w) with a/F0 = b/vmax = 1/4, 0 beyond w = −1; lengthening
/// rises to 1.4 with the same slope at w = 0. Slope with respect to w.
ValueSlope force_velocity(double w);

}  // namespace articular::sim
