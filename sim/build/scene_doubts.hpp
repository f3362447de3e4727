#pragma once

#include <string>
#include <vector>

#include "sim/build/body_geometry.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// What can be computed and is hardly meant: tissue tied to a bone across a gap of more than an
/// element and a tenth of its length, contact that is nearly as soft as what touches, tissue of
/// which every node is tied, loads and sheets on nothing but tied nodes, forces
/// that a support holds, reactions of bodies that nothing loads, contact of two fixed bodies,
/// ligaments that start drawn out by two fifths or get taut only when twice as long, joint axes
/// that do not point the same way or inwards, motions of fixed bodies that do not begin where these
/// are drawn, bodies or parts of a mesh that lie in each other unparted; and what muscle_doubts(),
/// body_doubts(), tie_doubts(), twin_doubts() and hold_doubts() find.
/// @param geometry  of each body at the start
/// @return one line each, with the place in the scenario
std::vector<std::string> scene_doubts(const Scenario& scenario, const Model& model,
                                      const std::vector<BodyGeometry>& geometry);

}  // namespace articular::sim
