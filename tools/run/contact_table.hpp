#pragma once

#include <string>

#include "sim/model/model.hpp"

namespace articular::tools {

/// Contact at the start: every pair with its stiffness, its non-mortar side and how near its
/// bodies are; what is tied to a body and may touch it too; the elements of the surfaces.
std::string contact_table(const sim::Model& model);

}  // namespace articular::tools
