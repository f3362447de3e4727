#pragma once

#include "sim/model/model.hpp"

namespace articular::sim {

/// Reads the meshes, resolves names and checks what only the geometry can tell.
/// @throws InputError
Model build_model(Scenario scenario);

}  // namespace articular::sim
