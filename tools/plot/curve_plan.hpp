#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/plot/axis_unit.hpp"
#include "tools/plot/common_x.hpp"
#include "tools/plot/plotted_run.hpp"
#include "tools/plot/probe_panels.hpp"
#include "tools/plot/thinned_curve.hpp"

/// Which curves of which runs are drawn, and in which panel.
namespace articular::tools {

/// One curve of a panel with what it was read from, in the units of the panel as written.
struct DrawnCurve {
  std::size_t panel = 0, run = 0, style = 0;
  double factor = 1;       // of y, from the run's unit to that of the panel
  std::size_t column = 0;  // of the run
  std::vector<std::vector<PlotPoint>> pieces;
};

struct CurvePlan {
  std::vector<sim::HistoryColumn> columns;
  std::vector<ProbePanel> panels;
  std::vector<AxisUnit> units;  // of the panels
  std::vector<DrawnCurve> curves;
};

/// Panels of the columns that the words mean (see chosen_columns()) with their curves, read in the
/// units of the panels. Without words those that are 0 in all rows are left out, unless all are.
/// @param remarks  what is not drawn, and why, is added to them
/// @throws sim::InputError  for words that mean nothing, units of another dimension than the first
///                          run's, more panels than a page holds, and what can't be read
CurvePlan plan_curves(const std::vector<PlottedRun>& runs, const std::vector<std::string>& probes,
                      const CommonX& x, std::vector<std::string>& remarks);

}  // namespace articular::tools
