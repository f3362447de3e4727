#pragma once

#include <vector>

#include "collision/mesh/surface.hpp"
#include "sim/build/body_geometry.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// Tissue::sheets of all tissues.
/// @param surfaces  one a tissue
/// @throws InputError where no face of the surface has its middle in a sheet's region, where fibres
/// cross one, or where a sheet lies on its own mirror image
void make_sheets(const Scenario& scenario, const std::vector<BodyGeometry>& geometry,
                 const std::vector<collision::Surface>& surfaces, Model& model);

}  // namespace articular::sim
