#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tools/fit/fit_file.hpp"
#include "tools/study/study_run.hpp"

/// Runs of the scenario for values of a fit's parameters.
namespace articular::tools {

/// Values of the parameters to try, in their units.
struct FitTrial {
  std::string name;  // for progress
  Eigen::VectorXd parameters;
};

/// Which measurements a trial is asked for.
enum class FitPart { Fitted, All };

/// What a trial says of each measurement of the part, in the order of Fit::measurements.
struct TrialValues {
  Eigen::VectorXd values;  // empty: a run failed
  std::string failure;     // which, and why
};

/// Runs all trials, `options.jobs` processes at a time. What an earlier call has run with the same
/// scenario, program and values is taken from the folder.
/// @throws StudyInterrupted, sim::InputError (a bad override, a column that is not there),
///         sim::SystemError
std::vector<TrialValues> run_trials(const Fit& fit, const std::vector<FitTrial>& trials,
                                    FitPart part, const StudyRunOptions& options);

/// Those measurements that a part has.
std::vector<FitMeasurement> measurements_of(const Fit& fit, FitPart part);

}  // namespace articular::tools
