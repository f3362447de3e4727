#pragma once

#include <string>
#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Entries that say the same twice, so that the scene has twice as much of it: gravities, loads on
/// the same faces, lines from the same points to the same points, sheets on the same faces with the
/// same fibres. Names may differ.
/// @return one line for each entry that has a twin before it, with both places in the scenario
std::vector<std::string> twin_doubts(const Scenario& scenario, const Model& model);

}  // namespace articular::sim
