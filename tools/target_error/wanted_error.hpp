#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/error_bars/error_bars.hpp"

/// What `articular run --target-error ERROR --of RESULT` asks for.
namespace articular::tools {

/// An error: a share of the result, or an amount with its unit.
struct WantedError {
  std::string text;      // as it was given: "2%", "0.05 mm"
  bool is_share = true;  // number 0.02 of "2 %"
  double number = 0;     // > 0
  std::string unit;      // of an amount; "": it has none
};

/// @throws sim::InputError  where it is no share above 0 and below 1, and no amount above 0
WantedError wanted_error(const std::string& text);

/// One number of a run.
struct WantedResult {
  std::string column;  // "tip.position.z [mm]"
  Quantity quantity = Quantity::End;
};

/// "tip.position.z", "plate.force:largest": a column of history.csv with or without its unit, or a
/// probe that has one column; then which of its values, the last one unless said.
/// @param columns  that there are
/// @throws sim::InputError  names the columns that are meant by a probe, or all probes
WantedResult wanted_result(const std::string& text, const std::vector<std::string>& columns);

/// "`tip.position.z [mm]` at the end".
std::string name_of(const WantedResult& result);

/// The error in the unit of the result's column.
struct ErrorGoal {
  double error = 0;
  double scale = 0;  // what a share is of; NaN: an amount was given
  std::string of;    // in words: "of how far it went, 1.95 mm"; "" where an amount was given
};

/// A share is one of the value. Of a coordinate it is one of the way between its largest and its
/// smallest value, as where zero lies means nothing.
/// @throws sim::InputError  where the run has no such value, where a share would be of nothing, or
///                          where the unit is of something else
ErrorGoal error_goal(const WantedError& error, const WantedResult& result,
                     const RunHistory& history);

}  // namespace articular::tools
