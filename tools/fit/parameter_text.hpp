#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tools/fit/fit_file.hpp"
#include "tools/study/braces.hpp"

/// Parameters of a fit as overrides of a scenario.
namespace articular::tools {

std::vector<std::string> parameter_names(const std::vector<FitParameter>& parameters);

/// What `run --set` is told in this run for these values of the parameters, in their units: the
/// run's own overrides with numbers for names in braces, then the paths of parameters.
/// @param values  one a parameter
std::vector<std::string> overrides_of(const Fit& fit, const FitRun& run,
                                      const Eigen::VectorXd& values);

}  // namespace articular::tools
