#pragma once

#include "sim/output.hpp"
#include "sim/stepper.hpp"

namespace articular::sim {

/// Writes one frame: every tissue, bone and the lines, with the arrays that the README names.
void write_frame(const Model& model, const Stepper& stepper, int index, double time,
                 FrameWriter& writer);

}  // namespace articular::sim
