#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/plot/axis_unit.hpp"
#include "tools/plot/plotted_run.hpp"

namespace articular::tools {

/// The axis that all panels have below them. In statics the time counts the load, and is shown as
/// its part in per cent.
struct CommonX {
  std::string name;
  AxisUnit unit;                    // of the first run
  std::vector<std::size_t> column;  // of each run
  std::vector<double> factor;       // from each run's column to `unit`
};

/// @param name  a column; "": the time, or the load where all runs are static
/// @throws sim::InputError  where a run has no such column, or one of another dimension than the
/// first
CommonX common_x(const std::vector<PlottedRun>& runs, const std::string& name);

}  // namespace articular::tools
