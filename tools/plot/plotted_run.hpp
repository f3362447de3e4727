#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/plot/axis_unit.hpp"
#include "tools/plot/probe_panels.hpp"
#include "tools/plot/thinned_curve.hpp"

/// Folders of results, as far as curves need them.
namespace articular::tools {

/// The last value of a column with its error bar, from error_bars.csv.
struct LastBar {
  sim::HistoryColumn column;
  double value = 0;
  std::optional<double> bar;  // none: not estimated
  std::string verdict;
};

struct PlottedRun {
  std::filesystem::path folder;
  std::vector<sim::HistoryColumn> columns;  // of history.csv; the first is the time
  std::string outcome;                      // of summary.json; "": unknown
  bool is_static = false;
  double duration = 0;  // [s], of the whole load in statics; 0: unknown
  std::vector<LastBar> bars;
};

/// @throws sim::InputError  where the folder or its history.csv can't be read or has no columns
PlottedRun open_run(const std::filesystem::path& folder);

/// The column of a name, or none.
std::optional<std::size_t> find_column(const PlottedRun& run, const std::string& name);

/// @throws sim::InputError  where it is no unit
AxisUnit unit_of_column(const PlottedRun& run, std::size_t column);

struct RunCurves {
  std::vector<ThinnedCurve> curves;
  std::size_t rows = 0;
  bool is_torn =
      false;  // the last line had no end and was left out: the run is writing, or was cut
};

/// Columns ys against column x, in one pass over the file: memory does not grow with its rows. A
/// blank cell or one that is not finite is no point.
/// @throws sim::InputError  with file:line, for a cell that is no number and a row that is cut
RunCurves read_curves(const PlottedRun& run, std::size_t x, const std::vector<std::size_t>& ys);

}  // namespace articular::tools
