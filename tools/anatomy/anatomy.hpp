#pragma once

#include <filesystem>

#include "tools/anatomy/anatomy_tables.hpp"

namespace articular::anatomy {

/// Writes every mesh and table of an anatomy into a folder, which is made if need be.
/// @throws sim::SystemError when that fails
void write_anatomy(const Anatomy& anatomy, const std::filesystem::path& folder);

}  // namespace articular::anatomy
