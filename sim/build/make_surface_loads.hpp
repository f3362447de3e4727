#pragma once

#include <vector>

#include "collision/mesh/surface.hpp"
#include "sim/build/body_geometry.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// Blocks are numbered.
/// @param body      index of the loaded tissue among the bodies
/// @param surfaces  one a tissue
/// @throws InputError where no face of the surface has its middle in the region
SurfaceLoadModel make_surface_load(const SurfaceLoad& load, int body, const Model& model,
                                   const std::vector<BodyGeometry>& geometry,
                                   const std::vector<collision::Surface>& surfaces);

}  // namespace articular::sim
