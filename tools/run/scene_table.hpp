#pragma once

#include <string>

#include "sim/model/model.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/step/stepper.hpp"

namespace articular::tools {

/// What was understood of a scenario, for somebody to compare with what was meant: bodies with
/// their place, volume, mass and elements; how many nodes each attachment has; muscles and
/// ligaments with length, direction and force at the start. Sections that a scene does not have are
/// left out.
/// @param start  as it is before the first step
std::string scene_table(const sim::Scenario& scenario, const sim::Model& model,
                        const sim::Stepper& start);

}  // namespace articular::tools
