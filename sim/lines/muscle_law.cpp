#include "sim/lines/muscle_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/material/muscle_fibre.hpp"
#include "sim/scenario/curve.hpp"

namespace articular::sim {
namespace {

ValueSlope cosine(double n) {
  if (n <= 0.5 || n >= 1.5) return {};
  const double angle = 2 * std::numbers::pi * n;
  return {0.5 * (1 + std::cos(angle)), -std::numbers::pi * std::sin(angle)};
}

ValueSlope parabola(double n) {
  return {fem::MuscleFibre::active(n), fem::MuscleFibre::active_slope(n)};
}

}  // namespace

double length_beyond(const Muscle& muscle, double t) {
  return muscle.beyond.time.empty() ? 0 : value_at(muscle.beyond, t);
}

ValueSlope active_force_length(Muscle::ForceLengthCurve curve, double length, double optimal_length,
                               double tendon_ratio) {
  const double fibre = optimal_length * (1 - tendon_ratio);
  const double n = (length - tendon_ratio * optimal_length) / fibre;
  const ValueSlope by_n = curve == Muscle::ForceLengthCurve::Cosine ? cosine(n) : parabola(n);
  return {by_n.value, by_n.slope / fibre};
}

ValueSlope passive_force_length(double length, double optimal_length, double max_ratio) {
  const double range = optimal_length * (max_ratio - 1);
  const double stretch = length - optimal_length;
  if (stretch <= 0) return {};
  if (stretch >= range) return {1, 0};
  return {stretch / range, 1 / range};
}

double passive_energy_length(double length, double optimal_length, double max_ratio) {
  const double range = optimal_length * (max_ratio - 1);
  const double stretch = length - optimal_length;
  if (stretch <= 0) return 0;
  const double ramp = std::min(stretch, range);
  return 0.5 * ramp * ramp / range + std::max(0.0, stretch - range);
}

}  // namespace articular::sim
