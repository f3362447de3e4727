#include "tools/study/braces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <stdexcept>

#include "sim/scenario/quantity.hpp"

namespace articular::tools {
namespace {

/// factor * NAME + added, with its place in the text.
struct Brace {
  std::string name;
  double factor = 1, added = 0;
  std::size_t begin = 0, end = 0;  // with the braces
};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::size_t after_blanks(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(' ', at), text.size());
}

/// A number at a place, which moves behind it and the blanks after it.
std::optional<double> number_at(std::string_view text, std::size_t& at) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), number);
  if (error != std::errc()) return {};
  at = after_blanks(text, static_cast<std::size_t>(end - text.data()));
  return number;
}

/// What begins at an opening brace, if it is a name with or without numbers.
std::optional<Brace> brace_at(std::string_view text, std::size_t begin) {
  std::size_t at = after_blanks(text, begin + 1);
  const std::size_t name = at;
  while (at < text.size() && is_word(text[at])) ++at;
  if (at == name || !is_letter(text[name])) return {};
  Brace brace{std::string(text.substr(name, at - name)), 1, 0, begin, 0};
  at = after_blanks(text, at);
  if (at < text.size() && text[at] == '*') {
    at = after_blanks(text, at + 1);
    const std::optional<double> factor = number_at(text, at);
    if (!factor) return {};
    brace.factor = *factor;
  }
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) {
    const double sign = text[at] == '-' ? -1 : 1;
    at = after_blanks(text, at + 1);
    const std::optional<double> size = number_at(text, at);
    if (!size || !(*size >= 0)) return {};
    brace.added = sign * *size;
  }
  if (at >= text.size() || text[at] != '}') return {};
  brace.end = at + 1;
  return brace;
}

std::vector<Brace> braces_in(std::string_view text) {
  std::vector<Brace> braces;
  for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1))
    if (at == 0 || text[at - 1] != '$')
      if (std::optional<Brace> brace = brace_at(text, at)) braces.push_back(std::move(*brace));
  return braces;
}

/// What stands between a brace and the end of its value, but for numbers and other braces: the unit
/// of a number, or of a vector.
std::string_view unit_behind(std::string_view text, std::size_t at) {
  text = text.substr(at, text.find_first_of("\"',]", at) - at);
  while (true) {
    text.remove_prefix(after_blanks(text, 0));
    std::size_t end = 0;
    if (text.starts_with('{'))
      end = std::min(text.find('}'), text.size() - 1) + 1;
    else if (!number_at(text, end))
      return text;
    text.remove_prefix(end);
  }
}

/// Of the same kind, and another size.
bool differ_in_size(const std::string& a, const std::string& b) try {
  const sim::MeasuredUnit of_a = sim::parse_any_unit(a), of_b = sim::parse_any_unit(b);
  return of_a.dimension == of_b.dimension && of_a.size != of_b.size;
} catch (const std::invalid_argument&) {
  return false;  // words of a command
}

}  // namespace

std::vector<std::string> names_in_braces(std::string_view text) {
  std::vector<std::string> names;
  for (const Brace& brace : braces_in(text)) names.push_back(brace.name);
  return names;
}

std::string with_numbers(const std::string& text, const std::vector<std::string>& names,
                         const Eigen::VectorXd& values) {
  std::string result;
  std::size_t rest = 0;
  for (const Brace& brace : braces_in(text)) {
    const auto name = std::find(names.begin(), names.end(), brace.name);
    const bool is_quoted = brace.begin > rest && text[brace.begin - 1] == '"' &&
                           brace.end < text.size() && text[brace.end] == '"';
    result += text.substr(rest, brace.begin - rest - (is_quoted ? 1 : 0));
    result += fmt::format("{}", brace.factor * values[name - names.begin()] + brace.added);
    rest = brace.end + (is_quoted ? 1 : 0);
  }
  return result + text.substr(rest);
}

std::string wrong_unit(std::string_view text, const std::vector<std::string>& names,
                       const std::vector<std::string>& units) {
  for (const Brace& brace : braces_in(text)) {
    const std::string behind(unit_behind(text, brace.end));
    const std::string& own = units[static_cast<std::size_t>(
        std::find(names.begin(), names.end(), brace.name) - names.begin())];
    if (brace.factor == 1 && differ_in_size(behind, own))
      return fmt::format(
          "`{{{0}}}` is a number of {1} and stands before {2}: expected `{{{0}}} {1}`", brace.name,
          own, behind);
  }
  return "";
}

bool is_parameter_name(const std::string& text) {
  return !text.empty() && is_letter(text[0]) && std::all_of(text.begin(), text.end(), is_word);
}

}  // namespace articular::tools
