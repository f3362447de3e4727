#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tools/study/population_text.hpp"

namespace articular::tools {

/// What a population study says, with histograms, tornados, Sobol indices and pictures, as one
/// self-contained page in HTML.
/// @param pictures  see draw_extremes()
/// @throws sim::SystemError  when the program was built without the page of reports
std::string population_page(const PopulationStudy& all,
                            const std::map<std::size_t, std::filesystem::path>& pictures);

}  // namespace articular::tools
