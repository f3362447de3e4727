#pragma once

namespace articular::fem {

/// Of fast lengthening, of the isometric force.
inline constexpr double kMostForceOfVelocity = 1.4;

/// A function's value and derivative.
struct ValueSlope {
  double value = 0, slope = 0;
};

/// Force–velocity factor of the lengthening rate w of muscle fibres, in their largest speed of
/// shortening. Shortening (w < 0): Hill's hyperbola (1 + w)/(1 − 4w) with a/F0 = b/vmax = 1/4, 0
/// beyond w = −1. Lengthening rises to 1.4, with the same slope at w = 0.
ValueSlope force_velocity(double w);

/// For Newton's iteration with the factor f as an unknown beside w: both branches are hyperbolas,
/// G(w, f) = f (1 − 4w) − (1 + w) = 0, and this is the slope −(∂G/∂w)/(∂G/∂f) at a pair that need
/// not be on the curve. On it, it is that of the curve.
double force_velocity_slope(double w, double factor);

}  // namespace articular::fem
