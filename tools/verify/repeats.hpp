#pragma once

#include "tools/verify/problem.hpp"

namespace articular::tools {

/// The same run in other ways, which must leave the same bits: resumed; on more threads.
std::vector<Problem> repeat_problems();

}  // namespace articular::tools
