#include "fem/material/force_velocity.hpp"

namespace articular::fem {

ValueSlope force_velocity(double w) {
  constexpr double kCurvature = 4;        // F0/a
  constexpr double kEccentricGain = 0.4;  // above 1 at fast lengthening
  // Slope at w = 0 from both sides: 1 + kCurvature = kEccentricGain * kEccentricRate.
  constexpr double kEccentricRate = (1 + kCurvature) / kEccentricGain;
  if (w <= -1) return {};
  if (w <= 0) {
    const double d = 1 - kCurvature * w;
    return {(1 + w) / d, (1 + kCurvature) / (d * d)};
  }
  const double d = 1 + kEccentricRate * w;
  return {1 + kEccentricGain * kEccentricRate * w / d, kEccentricGain * kEccentricRate / (d * d)};
}

}  // namespace articular::fem
