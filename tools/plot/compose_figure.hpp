#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/plot/figure.hpp"
#include "tools/plot/plotted_run.hpp"
#include "tools/plot/published_range.hpp"

namespace articular::tools {

/// What of the runs is drawn.
struct FigureRequest {
  std::vector<PlottedRun> runs;
  std::vector<std::string> labels;      // of the runs, for the legend
  std::vector<std::string> probes;      // words, see chosen_columns(); none: all
  std::string x;                        // a column; "": time, or load in statics
  std::vector<Interval> bands, ranges;  // over all x; limits of y
  std::vector<BandTable> band_tables;
  std::optional<Interval> x_range;
};

struct ComposedFigure {
  Figure figure;
  std::vector<std::string> remarks;  // what is not drawn, and why
};

/// Reads the curves and puts them into panels, in the units that the axes show.
/// @throws sim::InputError  for unknown probes, units of another dimension, and what can't be read
ComposedFigure compose_figure(const FigureRequest& request);

}  // namespace articular::tools
