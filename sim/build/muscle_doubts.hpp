#pragma once

#include <string>
#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Muscles that can be computed and never pull: fibres that a muscle activates and whose material
/// has no active stress, fibres with one that no muscle activates, muscles of fibres without
/// excitation, fibres that can hardly pull as they are drawn or break off on their way, and lines
/// of which none in the scene has an excitation. One line with an excitation says that the others
/// are silent on purpose; so does an excitation that is 0.
/// @return one line each, with the place in the scenario
std::vector<std::string> muscle_doubts(const Scenario& scenario, const Model& model);

}  // namespace articular::sim
