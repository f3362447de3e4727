#pragma once

#include "tools/verify/problem.hpp"

namespace articular::tools {

/// Bodies that touch: patch test, a ball on a layer, friction.
std::vector<Problem> contact_problems();

}  // namespace articular::tools
