#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <string>

#include "tools/render/colour_map.hpp"

/// What the colours of a picture mean.
namespace articular::tools {

struct Survey;

struct ColourScale {
  std::string title;  // "von Mises stress"
  std::string unit;   // of the numbers shown; "" without
  double factor = 1;  // from the unit in the files to the one shown
  vtkSmartPointer<vtkLookupTable> colours;
  // In the unit shown, where colours end before the values do.
  std::optional<double> lowest_below, highest_above;
  bool has_blank = false;
};

/// The ends of a scale as the user writes them: "0", "120 kPa".
struct AskedRange {
  std::string low, high;
};

/// Colours of the surveyed field. Unless asked for, the range goes from the value at rest to a
/// round number above the largest value, or above the 99.5th percentile where single peaks stick
/// out; to both sides of the value at rest where there are values on both.
/// @param map  a name of colour_maps(); "": viridis, or blue-red with values on both sides
/// @throws InputError for an unknown map; a range whose unit does not measure the field, or that is
///         no range
ColourScale field_scale(const Survey& survey, const std::optional<AskedRange>& range,
                        const std::string& map);

/// Of all muscles: 0 to 1. Of ligaments: 0 to a round number above the largest tension [N].
ColourScale activation_scale();
ColourScale tension_scale(double highest);

/// "0 to 120 kPa"
std::string range_text(const ColourScale& scale);

/// The next of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below the value.
double round_up(double value);

}  // namespace articular::tools
