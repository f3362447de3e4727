#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/study/study_run.hpp"
#include "tools/study/study_values.hpp"

namespace articular::tools {

/// A run in the folder of a target, as a process of its own.
struct PilotRun {
  std::string name;                    // "coarse", "coarser mesh"
  std::vector<std::string> overrides;  // after those of the scenario
  std::string failure = {};            // why there are no results, "" where there are
  double seconds = 0;
  RunHistory history = {};  // with the sizes of forces
};

struct PilotFolder {
  std::filesystem::path scenario, folder;
  std::vector<std::string> overrides;  // that the scenario was read with
  int threads = 1;
  bool reproducible = false, quiet = false;
};

/// history.csv of a run, with the sizes of forces.
RunHistory quoted_history(const std::filesystem::path& results);

/// Runs it alone, so that its time can be compared. What was done before for the same arguments is
/// read; what failed before is tried again.
/// @param time_limit  [s]
/// @throws StudyInterrupted
void run_pilot(const PilotFolder& place, double time_limit, PilotRun& run);

/// Where its results are.
std::filesystem::path results_of(const PilotFolder& place, const PilotRun& run);

}  // namespace articular::tools
