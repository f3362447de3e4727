#include "tools/fit/parameter_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace articular::tools {
namespace {

/// {NAME}, {NAME + 2} or {NAME - 2} in a text.
struct Brace {
  std::string name;
  double added = 0;
  std::size_t begin = 0, end = 0;  // with the braces
};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::size_t after_blanks(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(' ', at), text.size());
}

/// What begins at an opening brace, if it is a name with or without a number.
std::optional<Brace> brace_at(std::string_view text, std::size_t begin) {
  std::size_t at = after_blanks(text, begin + 1);
  const std::size_t name = at;
  while (at < text.size() && is_word(text[at])) ++at;
  if (at == name || !is_letter(text[name])) return {};
  Brace brace{std::string(text.substr(name, at - name)), 0, begin, 0};
  at = after_blanks(text, at);
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) {
    const double sign = text[at] == '-' ? -1 : 1;
    const std::size_t number = after_blanks(text, at + 1);
    double size = 0;
    const auto [end, error] =
        std::from_chars(text.data() + number, text.data() + text.size(), size);
    if (error != std::errc() || !(size >= 0)) return {};
    brace.added = sign * size;
    at = after_blanks(text, static_cast<std::size_t>(end - text.data()));
  }
  if (at >= text.size() || text[at] != '}') return {};
  brace.end = at + 1;
  return brace;
}

std::vector<Brace> braces_in(std::string_view text) {
  std::vector<Brace> braces;
  for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1))
    if (std::optional<Brace> brace = brace_at(text, at)) braces.push_back(std::move(*brace));
  return braces;
}

/// The text with numbers for names in braces.
std::string with_numbers(const std::string& text, const std::vector<std::string>& names,
                         const Eigen::VectorXd& values) {
  std::string result;
  std::size_t rest = 0;
  for (const Brace& brace : braces_in(text)) {
    const auto name = std::find(names.begin(), names.end(), brace.name);
    result += text.substr(rest, brace.begin - rest);
    result += fmt::format("{}", values[name - names.begin()] + brace.added);
    rest = brace.end;
  }
  return result + text.substr(rest);
}

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

std::vector<std::string> names_in_braces(std::string_view text) {
  std::vector<std::string> names;
  for (const Brace& brace : braces_in(text)) names.push_back(brace.name);
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
