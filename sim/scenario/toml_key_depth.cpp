#include "sim/scenario/toml_key_depth.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace articular::sim {
namespace {

/// Behind the text that begins at `at` with a quote, single or double, one or three of them.
std::size_t behind_text(std::string_view toml, std::size_t at) {
  const char quote = toml[at];
  const bool has_escapes = quote == '"';
  const std::size_t quotes =
      toml.substr(at, 3) == std::string_view(has_escapes ? "\"\"\"" : "'''") ? 3 : 1;
  const std::string_view end = toml.substr(at, quotes);
  for (at += quotes; at < toml.size(); ++at) {
    if (has_escapes && toml[at] == '\\')
      ++at;
    else if (toml.substr(at, quotes) == end || (quotes == 1 && toml[at] == '\n'))
      return at + quotes;
  }
  return toml.size();
}

}  // namespace

KeyDepth deepest_key(std::string_view toml) {
  KeyDepth deepest;
  int line = 1, dots = 0;
  int before_equals = 0;          // parts of the key whose value is read
  int around = 0;                 // parts of the keys in whose values it stands
  std::vector<int> of_container;  // of these, by open bracket
  for (std::size_t at = 0; at < toml.size(); ++at) {
    switch (toml[at]) {
      case '"':
      case '\'': {
        const std::size_t end = std::min(behind_text(toml, at), toml.size());
        line += static_cast<int>(std::count(toml.begin() + static_cast<std::ptrdiff_t>(at),
                                            toml.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
        at = end - 1;
        break;
      }
      case '#':
        at = std::min(toml.find('\n', at), toml.size()) - 1;
        break;
      case '.':
        if (around + ++dots >= deepest.parts) deepest = {around + dots + 1, line};
        break;
      case '=':
        before_equals = dots + 1;
        dots = 0;
        break;
      case '[':
      case '{':
        of_container.push_back(before_equals);
        around += before_equals;
        before_equals = dots = 0;
        break;
      case ']':
      case '}':
        if (!of_container.empty()) {
          around -= of_container.back();
          of_container.pop_back();
        }
        before_equals = dots = 0;
        break;
      case '\n':
        ++line;
        [[fallthrough]];
      case ',':
        before_equals = dots = 0;
        break;
      default:
        break;
    }
  }
  return deepest;
}

}  // namespace articular::sim
