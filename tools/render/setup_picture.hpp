#pragma once

#include "tools/render/render.hpp"

namespace articular::tools {

/// Draws a scenario as it is before the first step into OUT/NAME_setup.png: bodies by name, nodes
/// that are attached, ends of muscles and ligaments, axes and a scale. Nothing is run.
/// @param options  `run` is the scenario file; those of frames and fields are refused
/// @return 0
/// @throws InputError, SystemError
int render_setup(const RenderOptions& options);

}  // namespace articular::tools
