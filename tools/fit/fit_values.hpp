#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "sim/scenario/scenario.hpp"
#include "tools/fit/fit_file.hpp"
#include "tools/study/study_values.hpp"

/// What the results of a run say of a measurement.
namespace articular::tools {

/// The value of a measurement in a run. In time it is linear between the rows of the history. A
/// static run has its rows alone: no line joins equilibria that were not computed.
/// @throws sim::InputError       no such column (names the nearest), columns of different units, a
///                               time that the run does not have, or a cell that is empty there
double measured_value(const FitMeasurement& measurement, const RunHistory& history,
                      sim::Scenario::Analysis analysis, const std::string& fit_file);

/// How far a value is from what was measured, in standard deviations.
double difference_in_spreads(const FitMeasurement& measurement, double value);

/// The same, but 0 on the allowed side of a limit.
double misfit(const FitMeasurement& measurement, double value);

/// Root of the mean square of the misfits of those measurements that count; 0 where none does.
/// @param values  of all measurements
double mean_misfit(const Fit& fit, const Eigen::VectorXd& values,
                   const std::function<bool(const FitMeasurement&)>& counts);

}  // namespace articular::tools
