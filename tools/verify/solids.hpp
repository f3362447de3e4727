#pragma once

#include "tools/verify/problem.hpp"

namespace articular::tools {

/// Tissue in equilibrium, without contact: patch test, cantilevers, torsion.
std::vector<Problem> solid_problems();

}  // namespace articular::tools
