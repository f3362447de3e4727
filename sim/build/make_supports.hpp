#pragma once

#include <vector>

#include "collision/mesh/surface.hpp"
#include "sim/build/body_geometry.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// Model::supports, and the held blocks of their nodes in the order of the blocks. Axes of several
/// supports at one node hold together all directions that they span. Nodes are attached and blocks
/// numbered.
/// @param surfaces  one a tissue
/// @throws InputError where a support holds no node, or one that is attached; where one that is
/// driven and another hold a node along the same direction
void make_supports(const Scenario& scenario, const std::vector<BodyGeometry>& geometry,
                   const std::vector<collision::Surface>& surfaces, Model& model);

}  // namespace articular::sim
