#pragma once

#include "sim/lines/muscle_law.hpp"
#include "sim/model/state.hpp"

namespace articular::sim {

/// Force of food [N] over the depth d by which it is pressed together [m], and its slope. D is the
/// deepest that it was so far:
///
///   F = s f(d)                           for d ≥ D: the food is crushed on
///   F = max(0, s f(D) − k (D − d))       for d < D: it springs back by the slope k
///
/// f is piecewise linear over Bolus::depth, constant beyond. It may fall: the food breaks. The
/// strength s is 1 until it is let go.
ValueSlope bolus_force(const Bolus& bolus, const BolusState& state, double depth);

/// What it would give back from there: F² / 2k [J].
double bolus_energy(const Bolus& bolus, const BolusState& state, double depth);

/// It was pressed to this depth. Where it is deeper than ever it stays so. Where it was crushed
/// since it was let go last, and does not push any more, it loses strength.
/// @return what it took for good: ∫ s f dd over what was crushed, without what it stores more [J]
double crush(const Bolus& bolus, double depth, BolusState& state);

}  // namespace articular::sim
