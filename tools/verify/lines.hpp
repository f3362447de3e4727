#pragma once

#include "tools/verify/problem.hpp"

namespace articular::tools {

/// Muscles and ligaments as lines, and a muscle with sheets of fibres.
std::vector<Problem> line_problems();

}  // namespace articular::tools
