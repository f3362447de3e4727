#include "sim/lines/bolus_law.hpp"

#include <algorithm>

#include "sim/scenario/curve.hpp"

namespace articular::sim {
namespace {

/// ∫ f dd from one depth to another [J].
double area(const Curve& force, double from, double to) {
  double sum = 0;
  const auto add = [&](double end) {
    sum += 0.5 * (value_at(force, from) + value_at(force, end)) * (end - from);
    from = end;
  };
  for (const double corner : force.time)
    if (corner > from && corner < to) add(corner);
  add(to);
  return sum;
}

}  // namespace

ValueSlope bolus_force(const Bolus& bolus, const BolusState& state, double depth) {
  if (!(depth > 0)) return {};
  const double s = state.strength, k = bolus.unloading_stiffness;
  if (depth >= state.deepest)
    return {s * value_at(bolus.force, depth), s * slope_at(bolus.force, depth)};
  const double force = s * value_at(bolus.force, state.deepest) - k * (state.deepest - depth);
  if (!(force > 0)) return {};
  return {force, k};
}

double bolus_energy(const Bolus& bolus, const BolusState& state, double depth) {
  const double force = bolus_force(bolus, state, depth).value;
  return 0.5 * force * force / bolus.unloading_stiffness;
}

double crush(const Bolus& bolus, double depth, BolusState& state) {
  if (depth > state.deepest) {
    const double stored = bolus_energy(bolus, state, state.deepest);
    const double work = state.strength * area(bolus.force, state.deepest, depth);
    state.deepest = depth;
    return work - (bolus_energy(bolus, state, depth) - stored);
  }
  if (state.deepest > state.let_go && !(bolus_force(bolus, state, depth).value > 0)) {
    state.let_go = state.deepest;
    state.strength *= bolus.force_kept;
  }
  return 0;
}

}  // namespace articular::sim
