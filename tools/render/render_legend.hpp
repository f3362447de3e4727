#pragma once

#include <vtkRenderer.h>

#include <optional>
#include <string>
#include <vector>

#include "tools/render/colour_scale.hpp"
#include "tools/render/page.hpp"
#include "tools/render/view.hpp"

/// What is read beside a picture: text, colour scales, the length scale and the axes. All places
/// are in pixels from the lower left corner of the page.
namespace articular::tools {

/// Where text and scales are put.
struct Sheet {
  vtkRenderer& renderer;  // over the whole page
  const Page& page;
  Rgb ink;
};

enum class Align { Left, Centre, Right };

struct TextStyle {
  double size = 1;  // of the page's text
  bool bold = false;
  Align align = Align::Left;                 // of x; y is the middle of the line
  std::optional<Rgb> ground = std::nullopt;  // laid thinly behind text that stands over a scene
};

void add_text(const Sheet& sheet, const std::string& text, double x, double y,
              const TextStyle& style);

/// [pixel]
double text_width(const std::string& text, double height, bool bold);

/// Title and moment of a panel. A title too long for it is written smaller.
void add_heading(const Sheet& sheet, const Rect& rect, const std::string& title,
                 const std::string& moment);

/// The width that add_field_legend() needs. [pixel]
double legend_width(const Page& page, const ColourScale& scale);

/// Upright, with its labels, what lies beyond its ends, and the colour of what is blank.
void add_field_legend(const Sheet& sheet, const Rect& rect, const ColourScale& scale);

/// Lying, one after the other from the left.
void add_line_legends(const Sheet& sheet, const Rect& foot, const std::vector<ColourScale>& scales);

/// At the right end of the foot. @param pixel  its size in the scene, in the unit
void add_scale_bar(const Sheet& sheet, const Rect& foot, double pixel, const std::string& unit);

/// The width that add_axes() needs. [pixel]
double axes_width(const Page& page, const ViewAxes& axes, const Directions& directions);

/// At the lower end of the rectangle: x, y and z, or what they are called. One that points to the
/// eye or away from it has no length and is left out.
void add_axes(const Sheet& sheet, const Rect& rect, const ViewAxes& axes,
              const Directions& directions);

/// Labels of a scale: 4 to 6 round numbers from its low to its high end.
std::vector<double> round_labels(double low, double high);

}  // namespace articular::tools
