#include "fem/material/force_velocity.hpp"

namespace articular::fem {

namespace {

constexpr double kCurvature = 4;                             // F0/a
constexpr double kEccentricGain = kMostForceOfVelocity - 1;  // at fast lengthening
// Slope at w = 0 from both sides: 1 + kCurvature = kEccentricGain * kEccentricRate.
constexpr double kEccentricRate = (1 + kCurvature) / kEccentricGain;

}  // namespace

ValueSlope force_velocity(double w) {
  if (w <= -1) return {};
  if (w <= 0) {
    const double d = 1 - kCurvature * w;
    return {(1 + w) / d, (1 + kCurvature) / (d * d)};
  }
  const double d = 1 + kEccentricRate * w;
  return {1 + kEccentricGain * kEccentricRate * w / d, kEccentricGain * kEccentricRate / (d * d)};
}

double force_velocity_slope(double w, double factor) {
  if (w <= -1 && factor <= 0) return 0;
  if (w <= 0) return (1 + kCurvature * factor) / (1 - kCurvature * w);
  return kEccentricRate * (kMostForceOfVelocity - factor) / (1 + kEccentricRate * w);
}

}  // namespace articular::fem
