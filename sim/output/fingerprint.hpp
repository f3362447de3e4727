#pragma once

#include <string>

#include "sim/model/model.hpp"

namespace articular::sim {

/// What a checkpoint belongs to: the scenario's content and what was read from other files (meshes,
/// muscle tables). A run of another scenario must not resume from it.
std::string fingerprint(const Scenario& scenario, const Model& model);

}  // namespace articular::sim
