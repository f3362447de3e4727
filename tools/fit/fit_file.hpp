#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tools/study/study_settings.hpp"

/// FIT.toml: a scenario, what in it is not known, and what was measured. tools/fit/README.md has
/// the format.
namespace articular::tools {

/// A number of the scenario that the fit may change. All values are in `unit`.
struct FitParameter {
  std::string name;
  std::string path;              // of `run --set`; "": it stands in {braces} in a `set` alone
  std::string unit;              // "mm"; "": a bare number
  double start = 0;              // where the search begins
  std::optional<double> known;   // without measurements; none: as `start`
  std::optional<double> spread;  // standard deviation of what is known
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  double step = 0;  // of the difference quotients, > 0
};

/// One way to run the scenario. Its overrides may hold {NAME}, {NAME + 2} or {NAME - 2}, which
/// stand for a parameter's number in its unit.
struct FitRun {
  std::string name;
  StudySettings settings;
};

enum class FitTarget { Value, AtMost, AtLeast };

/// A number that was measured, and where it stands in the results of a run.
struct FitMeasurement {
  std::string name;
  std::size_t run = 0;               // which of Fit::runs
  std::vector<std::string> columns;  // of history.csv, all of one unit; their sum counts
  double at = 0;                     // [s]
  std::optional<double> minus;       // [s]; the value here is taken off
  FitTarget target = FitTarget::Value;
  double value = 0;       // in the columns' unit
  double spread = 1;      // standard deviation, in the same unit, > 0
  bool held_out = false;  // compared at the end, but not fitted
  std::string group;      // left out together in a cross-validation; "": never
};

struct Fit {
  std::filesystem::path file, scenario;
  std::string name, title;           // name: the file's, without its ending
  std::optional<double> time_limit;  // of a run [s]
  std::vector<FitParameter> parameters;
  std::vector<FitRun> runs;  // at least one
  std::vector<FitMeasurement> measurements;
};

/// The keys of a fit file.
const sim::KeyTable& fit_keys();

/// @throws sim::InputError  with file, line and column
Fit read_fit(const std::filesystem::path& file);

}  // namespace articular::tools
