#pragma once

#include <string>

#include "sim/assembly/moment.hpp"
#include "sim/model/model.hpp"

namespace articular::tools {

/// Muscles and ligaments with length, direction and force at the start, the bodies that they wrap
/// around, and those that they run through.
std::string line_table(const sim::Model& model, const sim::Moment& start);

}  // namespace articular::tools
