#pragma once

#include <vector>

#include "collision/mesh/surface.hpp"
#include "sim/build/body_geometry.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// The elements, masses and fibres of a tissue; what moves its nodes is not known yet.
/// @param body      index into the scenario's bodies
/// @param geometry  of each of them
/// @throws InputError with the place in the scenario
Tissue make_tissue(const Scenario& scenario, const Model& model,
                   const std::vector<BodyGeometry>& geometry, const collision::Surface& surface,
                   int body);

}  // namespace articular::sim
