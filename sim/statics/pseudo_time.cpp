#include "sim/statics/pseudo_time.hpp"

#include <algorithm>

namespace articular::sim {
namespace {

/// Of the reach: the first step.
constexpr double kFirstMotion = 0.25;
/// After a step that moved, and after one that failed.
constexpr double kMotionRise = 4, kMotionFall = 0.2;

}  // namespace

bool approach_in_pseudo_time(double reach, int most,
                             const std::function<PseudoStep(double motion)>& take) {
  double motion = kFirstMotion * reach;
  for (int k = 0; k < most; ++k) {
    const PseudoStep step = take(motion);
    if (step == PseudoStep::Arrived) return true;
    if (step == PseudoStep::GaveUp) return false;
    motion =
        step == PseudoStep::Moved ? std::min(kMotionRise * motion, reach) : kMotionFall * motion;
  }
  return false;
}

}  // namespace articular::sim
