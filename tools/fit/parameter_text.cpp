#include "tools/fit/parameter_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

namespace articular::tools {
namespace {

const std::regex& braces() {
  static const std::regex pattern(
      R"(\{ *([A-Za-z][A-Za-z0-9_]*) *(?:([+-]) *([0-9]+\.?[0-9]*(?:[eE][+-]?[0-9]+)?) *)?\})");
  return pattern;
}

/// The text with numbers for names in braces.
std::string with_numbers(const std::string& text, const std::vector<std::string>& names,
                         const Eigen::VectorXd& values) {
  std::string result;
  auto rest = text.cbegin();
  for (std::sregex_iterator match(text.begin(), text.end(), braces()), end; match != end; ++match) {
    const auto name = std::find(names.begin(), names.end(), (*match)[1].str());
    double number = values[name - names.begin()];
    if ((*match)[2].matched)
      number += ((*match)[2].str() == "-" ? -1 : 1) * std::stod((*match)[3].str());
    result.append(rest, (*match)[0].first);
    result += fmt::format("{}", number);
    rest = (*match)[0].second;
  }
  return result.append(rest, text.cend());
}

std::string override_of(const FitParameter& parameter, double value) {
  return parameter.unit.empty()
             ? fmt::format("{}={}", parameter.path, value)
             : fmt::format("{}=\"{} {}\"", parameter.path, value, parameter.unit);
}

}  // namespace

std::vector<std::string> parameter_names(const std::vector<FitParameter>& parameters) {
  std::vector<std::string> names;
  for (const FitParameter& parameter : parameters) names.push_back(parameter.name);
  return names;
}

std::vector<std::string> names_in_braces(std::string_view text) {
  const std::string whole(text);
  std::vector<std::string> names;
  for (std::sregex_iterator match(whole.begin(), whole.end(), braces()), end; match != end; ++match)
    names.push_back((*match)[1].str());
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
