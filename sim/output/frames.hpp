#pragma once

#include "sim/output/frame_writer.hpp"
#include "sim/step/stepper.hpp"

namespace articular::sim {

/// Writes one frame: every tissue, bone and the lines, and where the scenario asks for them the
/// surfaces that bodies touch with, with the arrays that the README names.
void write_frame(const Model& model, const Stepper& stepper, int index, double time,
                 FrameWriter& writer);

}  // namespace articular::sim
