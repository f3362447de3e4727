#pragma once

#include <string>
#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Regions `near` a body that tie a patch of a tissue to it, and one or two nodes far from that
/// patch as well: where the tissue only passes the body by, it is held instead of sliding.
/// @return one line for each two bodies, with the place in the scenario
std::vector<std::string> tie_doubts(const Scenario& scenario, const Model& model);

}  // namespace articular::sim
