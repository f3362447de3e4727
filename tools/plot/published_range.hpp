#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/plot/axis_unit.hpp"

/// Ranges that somebody published, and limits of axes, as arguments name them.
namespace articular::tools {

/// "[PROBE=]LO..HI [UNIT]", in SI.
struct Interval {
  std::string probe;  // "" where none is named
  double low = 0, high = 0;
  AxisUnit unit;
};

/// @param option  for messages: "--band"
/// @throws sim::InputError  says what was expected
Interval parse_interval(const std::string& text, const std::string& option);

/// A column of a table in SI, with the dimension that its unit says.
struct BandColumn {
  std::string name;
  AxisUnit unit;
  std::vector<double> values;  // in SI
};

/// A band over x, from a table of three columns: x, the lower and the upper end.
struct BandTable {
  std::string probe;  // "" where none is named
  std::string name;   // of the file, without its ending: what the legend says
  BandColumn x, low, high;
};

/// "[PROBE=]FILE.csv"
/// @throws sim::InputError  with file:line where the table is none of a band
BandTable read_band(const std::string& text);

/// Whether an argument of --band names a table.
bool is_band_table(std::string_view text);

}  // namespace articular::tools
