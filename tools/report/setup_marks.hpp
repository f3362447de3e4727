#pragma once

#include "sim/model/configuration.hpp"
#include "sim/model/model.hpp"
#include "tools/report/packed_numbers.hpp"

namespace articular::tools {

/// What holds and loads a scene, as the 3D view draws it: [{"name", "colour", "points"}], and loads
/// with "directions" beside the points (unit vectors, as many). What a scene has none of is left
/// out.
/// @param unit  of coordinates [m]
Json setup_marks(const sim::Model& model, const sim::Configuration& start, double unit);

}  // namespace articular::tools
