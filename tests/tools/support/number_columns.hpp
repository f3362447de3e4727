#pragma once

#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/sim/support/temporary_folder.hpp"

namespace articular {

/// The columns of a table of numbers.
inline std::map<std::string, std::vector<double>> columns(const std::filesystem::path& file) {
  std::istringstream lines(content(file));
  std::string line, cell;
  std::vector<std::string> names;
  std::getline(lines, line);
  for (std::istringstream row(line); std::getline(row, cell, ',');) names.push_back(cell);
  std::map<std::string, std::vector<double>> table;
  while (std::getline(lines, line)) {
    std::size_t c = 0;
    for (std::istringstream row(line); std::getline(row, cell, ',');)
      table[names[c++]].push_back(std::stod(cell));
  }
  return table;
}

}  // namespace articular
