#pragma once

namespace articular::fem {

/// A function's value and derivative.
struct ValueSlope {
  double value = 0, slope = 0;
};

/// Force–velocity factor of the lengthening rate w of muscle fibres, in their largest speed of
/// shortening. Shortening (w < 0): Hill's hyperbola (1 + w)/(1 − 4w) with a/F0 = b/vmax = 1/4, 0
/// beyond w = −1. Lengthening rises to 1.4, with the same slope at w = 0.
ValueSlope force_velocity(double w);

}  // namespace articular::fem
