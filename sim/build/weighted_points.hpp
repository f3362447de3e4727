#pragma once

#include <vector>

#include "collision/mesh/surface.hpp"
#include "sim/build/body_geometry.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// By node of a tissue: 1 where it lies on the surface.
std::vector<char> surface_nodes(const Tissue& tissue, const collision::Surface& surface);

/// The point of a body that an anchor names. Blocks are numbered.
/// @param body      index of the anchor's body
/// @param surfaces  one a tissue
WeightedPoint anchored_point(const Anchor& anchor, int body, const Model& model,
                             const std::vector<collision::Surface>& surfaces);

/// The mean of a tissue's nodes in a region; empty where there are none. Blocks are numbered.
/// @param tissue  index into Model::tissues
WeightedPoint region_point(const Region& region, int tissue, const Model& model,
                           const std::vector<BodyGeometry>& geometry,
                           const collision::Surface& surface);

}  // namespace articular::sim
