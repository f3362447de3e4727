#include "sim/model/layer_law.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace articular::sim {
namespace {

/// What is left of the thickness where the tangent begins.
constexpr double kLeft = 0.1;
constexpr double kEnd = std::numbers::ln10;  // p/M there

/// Of one layer, or all, at a pressure.
struct AtPressure {
  double depth = 0;       // [m]
  double compliance = 0;  // [m/Pa]
};

AtPressure at(const LogarithmicLayer& layer, double pressure) {
  const double x = pressure / layer.modulus;
  if (x <= kEnd) return {-layer.thickness * std::expm1(-x), layer.compliance() * std::exp(-x)};
  return {layer.thickness * (1 - kLeft + kLeft * (x - kEnd)), layer.compliance() * kLeft};
}

AtPressure at(const LayersInSeries& layers, double pressure) {
  AtPressure sum{layers.linear * pressure, layers.linear};
  for (const LogarithmicLayer& layer : layers.layer) {
    if (!(layer.thickness > 0)) continue;
    const AtPressure one = at(layer, pressure);
    sum.depth += one.depth;
    sum.compliance += one.compliance;
  }
  return sum;
}

/// ∫ x exp(−x) dx from 0 on. Its terms cancel where x is small: there its series, whose next term
/// is as small as round-off.
double stored(double x) {
  constexpr double kSmall = 0.01;
  if (x < kSmall) return x * x * (1. / 2 + x * (-1. / 3 + x * (1. / 8 + x * (-1. / 30 + x / 144))));
  return -std::expm1(-x) - x * std::exp(-x);
}

/// ∫ p dd = M t ∫ x exp(−x) dx with x = p/M [J/m²].
double energy(const LogarithmicLayer& layer, double pressure) {
  const double x = pressure / layer.modulus;
  const double part = x <= kEnd ? stored(x) : stored(kEnd) + 0.5 * kLeft * (x * x - kEnd * kEnd);
  return layer.modulus * layer.thickness * part;
}

/// p(g) for g > 0.
double pressure_at(const LayersInSeries& layers, double depth, double stiffness) {
  constexpr int kMost = 100;  // a few are enough
  constexpr double kRoundOff = 4 * std::numeric_limits<double>::epsilon();
  double pressure = stiffness * depth;
  for (int i = 0; i < kMost; ++i) {
    const AtPressure now = at(layers, pressure);
    const double step = (depth - now.depth) / now.compliance;
    pressure += step;
    if (!(step > kRoundOff * pressure)) break;
  }
  return pressure;
}

}  // namespace

PressedLayers pressed(const LayersInSeries& layers, double depth) {
  const double stiffness = 1 / at(layers, 0).compliance;
  PressedLayers result{0, stiffness * depth, stiffness};
  if (!(depth > 0)) return result;
  result.pressure = pressure_at(layers, depth, stiffness);
  result.slope = 1 / at(layers, result.pressure).compliance;
  result.energy = 0.5 * layers.linear * result.pressure * result.pressure;
  for (const LogarithmicLayer& layer : layers.layer)
    if (layer.thickness > 0) result.energy += energy(layer, result.pressure);
  return result;
}

}  // namespace articular::sim
