#pragma once

#include "sim/output/frame_writer.hpp"
#include "sim/step/stepper.hpp"

namespace articular::sim {

/// Writes one frame: every tissue, rigid body and the lines, with the arrays that the README names.
/// @param contact_surfaces  the surfaces that bodies touch with, too
/// @param time              [s]
void write_frame(const Model& model, const Stepper& stepper, bool contact_surfaces, int index,
                 double time, FrameWriter& writer);

}  // namespace articular::sim
