#pragma once

#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// A curve's value at a time; 1 for the empty curve.
double value_at(const Curve& curve, double t);

/// Its change per second; at a time of the curve that of the part which begins there.
double slope_at(const Curve& curve, double t);

/// Whether it has another value later than it has then.
bool changes_after(const Curve& curve, double t);

}  // namespace articular::sim
