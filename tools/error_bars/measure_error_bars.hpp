#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"

namespace articular::tools {

struct ErrorBarSettings {
  std::filesystem::path directory;     // of the run's results
  std::vector<std::string> overrides;  // that the run had
  double mesh_ratio = 0;               // of sizes from mesh to mesh; 0 chooses one
  int threads = 1;                     // in all: coarser runs go side by side
  bool goes_on = false;                // keeps coarser runs of the same inputs that are there
  bool quiet = false;                  // no progress on stderr
};

/// Runs a scenario again, coarser in one respect at a time, and writes error_bars.csv and
/// `error_bars` of summary.json into the folder of its results. The coarser runs go to its folder
/// `error-bars`; one that fails is left out of the bars, which say so.
/// @param scenario  of a run that has finished
/// @return the table for the terminal
/// @throws StudyInterrupted  the results of the run stay as they are
/// @throws sim::SystemError
std::string measure_error_bars(const sim::Scenario& scenario, const ErrorBarSettings& settings);

}  // namespace articular::tools
