#include "tools/fit/parameter_text.hpp"

#include <fmt/format.h>

namespace articular::tools {
namespace {

std::string override_of(const FitParameter& parameter, double value) {
  return parameter.unit.empty()
             ? fmt::format("{}={}", parameter.path, value)
             : fmt::format("{}=\"{} {}\"", parameter.path, value, parameter.unit);
}

}  // namespace

std::vector<std::string> parameter_names(const std::vector<FitParameter>& parameters) {
  std::vector<std::string> names;
  names.reserve(parameters.size());
  for (const FitParameter& parameter : parameters) names.push_back(parameter.name);
  return names;
}

std::vector<std::string> overrides_of(const Fit& fit, const FitRun& run,
                                      const Eigen::VectorXd& values) {
  const std::vector<std::string> names = parameter_names(fit.parameters);
  std::vector<std::string> overrides;
  for (const std::string& text : run.settings.overrides)
    overrides.push_back(with_numbers(text, names, values));
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (!fit.parameters[i].path.empty())
      overrides.push_back(override_of(fit.parameters[i], values[static_cast<Eigen::Index>(i)]));
  return overrides;
}

}  // namespace articular::tools
