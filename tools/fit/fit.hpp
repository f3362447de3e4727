#pragma once

#include <Eigen/Core>
#include <string>

#include "tools/fit/determination.hpp"
#include "tools/fit/fit_file.hpp"
#include "tools/study/study_run.hpp"

/// Parameters of a scenario from measurements.
namespace articular::tools {

/// Whether what the measurements determine is asked for: it takes a run more for each parameter.
enum class FitWidths { Found, LeftOut };

struct FitResult {
  Eigen::VectorXd parameters;     // fitted, in their units
  Eigen::VectorXd before, after;  // of every measurement, also those held out, in its unit
  Determination determination;    // of the parameters, in their units; where widths are found
  int iterations = 0;
  bool converged = false;
  std::string message;  // why it ended
};

/// Changes the parameters so that the sum of the squares of all misfits of fitted measurements, and
/// of how far parameters are from their start in their spreads, is least. Started again with the
/// same arguments it takes up where it was interrupted, from what has run.
/// @throws StudyInterrupted, sim::InputError, sim::SystemError
/// @throws sim::SimulationError  where the scenario does not run with the parameters' start
FitResult fit_parameters(const Fit& fit, int most_iterations, const StudyRunOptions& options,
                         FitWidths widths = FitWidths::Found);

}  // namespace articular::tools
