#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tools/study/population_text.hpp"

namespace articular::tools {

/// Draws the cases in which an output is least or largest, each once, into DIR/pictures/CASE, with
/// `articular render` and what the study says. What can't be drawn is said on stderr.
/// @return  folders with pictures, by case
std::map<std::size_t, std::filesystem::path> draw_extremes(const PopulationStudy& all,
                                                           const std::filesystem::path& directory);

}  // namespace articular::tools
