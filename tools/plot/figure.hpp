#pragma once

#include <string>
#include <vector>

#include "tools/plot/axis_range.hpp"
#include "tools/plot/thinned_curve.hpp"

/// A page of panels as plain data: values in the units that the axes show, texts as they are.
namespace articular::tools {

struct FigureCurve {
  std::vector<std::vector<PlotPoint>> pieces;  // gaps between them
  std::size_t style = 0;                       // of line_style()
};

/// The error bar of a value: from y - half to y + half.
struct FigureBar {
  double x = 0, y = 0, half = 0;
  std::size_t style = 0;
};

struct FigureBand {
  std::vector<double> x, low, high;
  std::size_t shade = 0;  // of band_colour()
};

struct FigureAxis {
  std::string label;        // "position [mm]"
  std::string short_label;  // "[mm]", where there is no room for more
  AxisRange range;
};

struct FigurePanel {
  std::string title;  // "incisor.position"
  FigureAxis x, y;
  std::vector<FigureCurve> curves;
  std::vector<FigureBar> bars;
  std::vector<FigureBand> bands;
};

struct LegendEntry {
  enum class Kind { Curve, Band };
  std::string text;
  Kind kind = Kind::Curve;
  std::size_t style = 0;  // or shade
};

struct Figure {
  std::vector<FigurePanel> panels;  // by rows
  std::vector<LegendEntry> legend;
};

}  // namespace articular::tools
