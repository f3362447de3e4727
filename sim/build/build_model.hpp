#pragma once

#include "sim/model/model.hpp"
#include "sim/model/step_settings.hpp"

namespace articular::sim {

/// Reads the meshes, resolves names and checks what only the geometry can tell.
/// @throws InputError
Model build_model(const Scenario& scenario);

/// The same scene in time, with soft contact that counts depths point by point.
/// @param scenario  that the model was built from
Model with_pointwise_contact(Model model, Scenario scenario);

/// How that model is moved on.
StepSettings step_settings(const Scenario& scenario);

}  // namespace articular::sim
