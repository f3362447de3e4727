#pragma once

#include <string>
#include <vector>

#include "collision/mesh/surface.hpp"
#include "sim/build/body_geometry.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// By node of a tissue: 1 where it lies on the surface.
std::vector<char> surface_nodes(const Tissue& tissue, const collision::Surface& surface);

/// The point of a body that an anchor names: of a rigid body the place itself; of tissue the place
/// in its tetrahedron, beside it the nearest node of the surface, with a radius the nodes of the
/// surface within that. Blocks are numbered.
/// @param body      index of the anchor's body
/// @param surfaces  one a tissue
/// @param warnings  get one where a radius holds fewer than two nodes
/// @throws InputError farther than an element from tissue, or a tenth of its size from a rigid
///         body, unless that goes on beyond its mesh
WeightedPoint anchored_point(const Anchor& anchor, int body, const Model& model,
                             const std::vector<collision::Surface>& surfaces,
                             std::vector<std::string>& warnings);

/// The mean of a tissue's nodes in a region; empty where there are none. Blocks are numbered.
/// @param tissue  index into Model::tissues
WeightedPoint region_point(const Region& region, int tissue, const Model& model,
                           const std::vector<BodyGeometry>& geometry,
                           const collision::Surface& surface);

}  // namespace articular::sim
