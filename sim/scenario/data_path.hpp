#pragma once

#include <filesystem>
#include <string>

#include "sim/scenario/toml_document.hpp"

namespace articular::sim {

/// The path that a scenario names: `${NAME}` is replaced by the environment variable, and what is
/// relative starts at the scenario's folder (a relative variable at the start: at the working
/// folder).
/// @throws InputError  if a variable is not set; whether the file exists is not looked at
std::filesystem::path read_path(const Node& node, const std::filesystem::path& folder);

}  // namespace articular::sim
