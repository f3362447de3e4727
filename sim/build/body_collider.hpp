#pragma once

#include <vector>

#include "sim/build/body_geometry.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// What of each body can touch, where the scenario lets it touch anything.
/// @param geometry  of each body
/// @throws InputError for surfaces that no shell can be laid under
void make_colliders(const Scenario& scenario, const std::vector<BodyGeometry>& geometry,
                    Model& model);

}  // namespace articular::sim
