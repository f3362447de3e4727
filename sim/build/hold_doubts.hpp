#pragma once

#include <string>
#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Forces and moments that a body's `hold` takes whole, wherever the body moves. Not of one beside
/// others that move it, where a probe tells the body's reaction. And angles about axes that a
/// `hold` keeps.
/// @return one line each, with the place in the scenario
std::vector<std::string> hold_doubts(const Scenario& scenario, const Model& model);

}  // namespace articular::sim
