#pragma once

#include "sim/scenario/toml_reader.hpp"
#include "tools/study/population.hpp"

namespace articular::tools {

const sim::KeyTable& population_keys();
const sim::KeyTable& population_parameter_keys();
const sim::KeyTable& population_correlation_keys();

/// [population], [[parameter]] and [[correlation]] of a study.
/// @param folder  that of the file
Population read_population(const sim::TableReader& document, const std::filesystem::path& folder);

}  // namespace articular::tools
