#pragma once

#include "sim/model/configuration.hpp"
#include "sim/model/model.hpp"
#include "tools/render/marks.hpp"
#include "tools/render/render_series.hpp"

/// A scenario before the first step, as a frame of a run would show it. `unit` is that of
/// coordinates in frames and marks [m].
namespace articular::tools {

/// Bodies that have a mesh, and "lines" if there are any, with cell arrays `name` and `kind` as a
/// run writes them.
Frame start_frame(const sim::Model& model, const sim::Configuration& start, double unit);

/// Nodes of tissue that move with a bone.
Marks::Points attached_nodes(const sim::Model& model, double unit);
/// Nodes of tissue that a support holds.
Marks::Points supported_nodes(const sim::Model& model, double unit);
/// Ends of muscles and ligaments.
Marks::Points line_ends(const sim::Model& model, const sim::Configuration& start, double unit);

}  // namespace articular::tools
