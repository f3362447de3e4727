#pragma once

#include <string>
#include <vector>

namespace articular::tools {

/// From where to where an axis goes, in the unit that it shows.
struct AxisRange {
  double low = 0, high = 0;
  bool operator==(const AxisRange&) const = default;
};

/// The size of its larger end.
double size_of(const AxisRange& range);

/// Room of a twentieth above and below, so that no curve lies on the frame. Where all values are
/// one but for round-off, the range is wide enough that they look like one.
AxisRange with_room(const AxisRange& values);

/// The same range, or a wider one where it has no length that can be divided.
AxisRange with_length(const AxisRange& values);

/// Where an axis is divided, and what stands there.
struct Ticks {
  std::vector<double> at;
  std::vector<std::string> labels;  // with a minus sign, U+2212
};

/// At multiples of 1, 2 or 5 times a power of ten, as many as there may be.
/// @param most  number that there is room for, 2 or more
Ticks ticks(const AxisRange& range, int most);

}  // namespace articular::tools
