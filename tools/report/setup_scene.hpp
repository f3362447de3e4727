#pragma once

#include <filesystem>

#include "tools/report/packed_numbers.hpp"

namespace articular::tools {

/// What the page shows of a scenario before any run: {"title", "settings", "scene"}. The scene is
/// as in run_scene(), with one moment; its bodies have "details", rows of what the scenario says of
/// them, and its "marks" are attached and supported nodes, ends of lines, and loads.
/// @throws InputError  for what is wrong with the scenario; where no body has a mesh
Json setup_of(const std::filesystem::path& scenario);

}  // namespace articular::tools
