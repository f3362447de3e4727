#pragma once

#include "tools/verify/problem.hpp"

namespace articular::tools {

/// "law/NAME" for each law of the scenario format: an irregular block of it, with plain and with
/// smoothed elements and the vector loops of this machine, under homogeneous strain.
std::vector<Problem> law_problems();

}  // namespace articular::tools
