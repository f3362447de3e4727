#pragma once

#include <string>
#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Sizes, masses, speeds, stiffnesses, forces, ways and places that no tissue, layer, bone or tool
/// has, time constants of no muscle, gravity of no planet, friction and toe strains in per cent,
/// and curves and food that begin when the run is over: most often a unit was meant otherwise. One
/// line each, with the place in the scenario. Of materials see law_doubts().
std::vector<std::string> unit_doubts(const Scenario& scenario, const Model& model);

}  // namespace articular::sim
