#pragma once

#include <string>
#include <vector>

#include "collision/mesh/surface.hpp"
#include "sim/build/body_geometry.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// The scenario's probes, with what they name looked up in a model that has all else.
/// @param geometry  of each body
/// @param surfaces  of each tissue
/// @param warnings  get what anchored_point() has to say
/// @throws InputError for a probe that observes nothing
std::vector<ProbeModel> make_probes(const Scenario& scenario, const Model& model,
                                    const std::vector<BodyGeometry>& geometry,
                                    const std::vector<collision::Surface>& surfaces,
                                    std::vector<std::string>& warnings);

}  // namespace articular::sim
