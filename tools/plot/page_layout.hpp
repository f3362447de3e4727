#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/plot/figure.hpp"

/// Where things stand on the page. Lengths in mm, from the lower left corner.
namespace articular::tools {

inline constexpr double kFontPoints = 7;                     // journals ask for 6 to 8
inline constexpr double kEm = kFontPoints * 25.4 / 72;       // [mm], size of the font
inline constexpr double kOneColumn = 85, kTwoColumns = 170;  // [mm], widths in a journal
inline constexpr double kSampleLength = 9;                   // [mm], of a line in the legend

/// What a text takes [mm], about: letters are not measured.
double text_width(std::string_view text);

/// The text, or as much of its beginning and end as there is room for, with "…" between.
std::string fitting(std::string_view text, double width);

struct Rectangle {
  double left = 0, right = 0, bottom = 0, top = 0;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// What --size asks for.
struct PageSize {
  std::optional<double> width, height;  // [mm]
};

struct PlacedEntry {
  double left = 0, middle = 0;  // of the line or patch; the text follows it
};

struct PageLayout {
  double width = 0, height = 0;
  std::vector<Rectangle> frames;    // of the panels' axes
  std::vector<bool> shows_x_label;  // the lowest panel of each column
  double title_width = 0;           // room for a panel's title
  double y_label = 0;               // from the middle of the label to the frame
  double x_label = 0;               // the same, below
  std::vector<PlacedEntry> legend;
  double legend_text = 0;  // room for each text
};

/// One panel takes a column of a journal, several two; up to three stand side by side.
/// @throws sim::InputError  where the size leaves no room
PageLayout page_layout(const Figure& figure, const PageSize& size);

/// As many ticks along an axis as there is room for their numbers.
Ticks x_ticks(const AxisRange& range, const Rectangle& frame);
Ticks y_ticks(const AxisRange& range, const Rectangle& frame);

}  // namespace articular::tools
