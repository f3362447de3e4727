#pragma once

#include <string>

namespace articular::tools {

/// A text as one cell of a CSV table.
std::string csv_cell(const std::string& text);

/// A number; "" where it is not finite.
std::string csv_cell(double value, int digits = 6);

}  // namespace articular::tools
