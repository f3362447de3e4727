#pragma once

#include <optional>
#include <string>
#include <vector>

/// How large a picture is, in pixels and in print, and where on it scene, text and scales stand.
namespace articular::tools {

struct Page {
  int width = 0, height = 0;  // [pixel]
  double text = 0;            // height of its text [pixel]
  std::optional<double> dpi;  // pixels an inch in print, where that is known
};

/// @param size  "1600x1000", pixels, or "170x110 mm", in print
/// @param dpi   of print; none: 300 for millimetres. With pixels alone the text is 2.5 % of the
///              smaller side, else it is 8 points in print, whatever the size.
/// @throws InputError for another size, one of less than 64 or more than 8192 pixels, and one that
///         has no room for its text
Page page_of(const std::string& size, std::optional<double> dpi);

/// The same with every pixel divided into n x n.
Page finer(const Page& page, int n);

/// In pixels from the lower left corner.
struct Rect {
  double x, y, width, height;
};

/// Nothing overlaps: scales stand beside the scene, never over it.
struct PageLayout {
  std::vector<Rect> headings;  // above the panels
  std::vector<Rect> panels;    // of the scene, side by side
  Rect legend;                 // on the right, as high as the page
  Rect foot;                   // below the panels
};

/// @param legend_width  [pixel]
PageLayout lay_out(const Page& page, int num_panels, double legend_width);

}  // namespace articular::tools
