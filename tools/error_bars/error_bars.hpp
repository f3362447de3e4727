#pragma once

#include <string>
#include <vector>

#include "tools/error_bars/coarser_runs.hpp"
#include "tools/error_bars/discretisation_error.hpp"

/// What each result of a run is worth: error bars from coarser runs.
namespace articular::tools {

/// What of a column of history.csv is quoted.
enum class Quantity { End, Largest, Smallest };

const char* name_of(Quantity quantity);

/// The error bar of one number.
struct ErrorBar {
  std::string column;  // "tip.position.z [mm]"
  Quantity quantity = Quantity::End;
  double value = 0;                        // in the column's unit
  double bar = kNoValue;                   // NaN: not estimated
  double scale = 0;                        // largest value of the column, or of its vector
  std::vector<DiscretisationError> parts;  // of each direction; NaN where it has no bar
  std::string doubts;                      // why the bar is no extrapolation; "" where it is
  std::string left_out;                    // errors that are not in the bar, and why; "": none
  bool is_estimated() const { return bar >= 0; }
  bool is_negligible() const;  // below a millionth of the scale: round-off, or balance of statics
};

/// The value of a quantity in a run; NaN where it has none. @throws sim::InputError  no such column
double quantity_value(const RunHistory& history, const std::string& column, Quantity quantity);

/// The largest size of a column in a run; of a component, that of any component of its vector.
double scale_of(const RunHistory& history, const std::string& column);

/// Adds what forces are quoted by, their sizes: "plate.force [N]" from "plate.force.x [N]", ...
void add_force_sizes(RunHistory& history);

/// Bars of the last row of every column, and of its largest and smallest value where they lie
/// between the first and the last row. Columns without a value are left out.
///
/// A bar is the sum of those of the directions: these errors are no chance, and may all have the
/// same sign. It counts as asymptotic where nine tenths of it are. Without the part of a direction
/// that is needed there is none.
std::vector<ErrorBar> error_bars(const RunHistory& history,
                                 const std::vector<Direction>& directions);

}  // namespace articular::tools
