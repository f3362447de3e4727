#pragma once

#include <string>
#include <string_view>

#include "sim/scenario/quantity.hpp"

/// Units of columns, as they are written and as an axis shows them.
namespace articular::tools {

/// "mm" of `incisor.position.z [mm]`.
struct AxisUnit {
  std::string text;          // as written; "-" where a number has no unit
  sim::Dimension dimension;  // none of "-" and "%"
  double size = 1;           // in SI
};

/// Units of scenario files (see quantity.hpp), and beside them "-", "" and "%".
/// @throws std::invalid_argument  says what was found
AxisUnit axis_unit(std::string_view text);

/// @param what  for the message: "--x-range"
/// @throws sim::InputError  where a dimension is another than that of the axis
void require_dimension(const sim::Dimension& found, const AxisUnit& expected,
                       const std::string& what);

/// By what values are multiplied before they are drawn, and the unit that they have then.
struct ShownUnit {
  double factor = 1;
  std::string text;  // "mm²", "kPa", "10⁻⁶ J"; "" where a number has no unit
};

/// A unit in which the largest value has few digits: ms for a run of less than a second, kPa and
/// MPa for large pressures, and a power of ten where no prefix serves.
/// @param largest  size of the largest value, in the unit as written
ShownUnit shown_unit(const AxisUnit& unit, double largest);

}  // namespace articular::tools
