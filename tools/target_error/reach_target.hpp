#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"

/// `articular run --target-error`: a run whose settings follow from the error that is wanted.
namespace articular::tools {

struct TargetSettings {
  std::string error, of;               // "2%", "tip.position.z"
  double budget = 3600;                // [s], of all runs together
  std::filesystem::path directory;     // of the run's results
  std::vector<std::string> overrides;  // that the scenario was read with
  int threads = 1;
  bool quiet = false;  // no progress on stderr
  /// Runs the scenario with overrides after these into the folder, or goes on from its checkpoint.
  /// It ends early, with kInterruptedExitCode, once it is to stop.
  /// @return the exit code
  std::function<int(const std::vector<std::string>& overrides, bool goes_on,
                    const std::function<bool()>& is_to_stop)>
      run;
};

struct TargetOutcome {
  int exit_code = 0;    // of the last run
  std::string text;     // the result and where it is from, for the terminal; "": there is none
  std::string refusal;  // why the target can't be met, and what can; "" where it is met
};

/// Runs coarser than the scenario, estimates how the error of one result falls with the sizes of
/// elements and steps, the softness of contact and the tolerance, and runs the cheapest settings
/// that are expected to meet the target. Where that run shows that they do not, it goes on from
/// there.
///
/// The coarser runs stay in the folder `target-error` of the results; what is there for the same
/// inputs is not run again. summary.json gets `target_error`.
/// @param scenario  as it is written
/// @throws StudyInterrupted
/// @throws sim::InputError, sim::SimulationError, sim::SystemError
TargetOutcome reach_target(const sim::Scenario& scenario, const TargetSettings& settings);

}  // namespace articular::tools
