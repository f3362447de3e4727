#pragma once

#include <functional>

namespace articular::sim {

enum class PseudoStep { Arrived, Moved, Failed, GaveUp };

/// Takes steps in pseudo-time, by which static solutions approach equilibrium, until one arrives.
/// How long a step is is said by how far it moves what the forces accelerate most [m]: the first by
/// a quarter of what may move in one, then farther after each that moved and less after each that
/// failed.
/// @param reach  [m] that no step moves farther than
/// @param most   steps before it is given up
/// @param take   a step by such a motion [m]
/// @return whether one arrived; not where one gave up
bool approach_in_pseudo_time(double reach, int most,
                             const std::function<PseudoStep(double motion)>& take);

}  // namespace articular::sim
