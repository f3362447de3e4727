#pragma once

#include "tools/verify/problem.hpp"

namespace articular::tools {

/// Bodies in motion: periods, momentum, energy.
std::vector<Problem> motion_problems();

}  // namespace articular::tools
