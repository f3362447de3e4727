#pragma once

#include <string>
#include <vector>

#include "sim/scenario/toml_reader.hpp"

/// Columns of history.csv that a key names: one, or a list of them whose sum counts.
namespace articular::tools {

sim::KeyType history_columns();

std::vector<std::string> read_history_columns(const sim::Node& node);

}  // namespace articular::tools
