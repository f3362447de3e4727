#pragma once

#include "sim/model/model.hpp"

namespace articular::tools {

/// Runs a scene until a step fails, finds which contact makes it fail, and prints what it finds;
/// progress goes to stderr. @return whether a step failed
bool diagnose(const sim::Scenario& scenario, const sim::Model& model, double seconds);

}  // namespace articular::tools
