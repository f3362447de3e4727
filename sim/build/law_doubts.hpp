#pragma once

#include <string>
#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Materials that no tissue has: moduli, active stresses, prestretches and times of damping of
/// another size, tissue that gets wider when it is drawn out, and collagen whose toe ends far off
/// or that is softer when straight than just before. One line each, with the place in the scenario;
/// of fibres that are wrong in themselves no more is said.
std::vector<std::string> law_doubts(const Scenario& scenario, const Model& model);

}  // namespace articular::sim
