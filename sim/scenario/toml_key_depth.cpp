#include "sim/scenario/toml_key_depth.hpp"

#include <algorithm>
#include <cstddef>

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
  int dots = 0, line = 1;
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
        if (++dots >= deepest.parts) deepest = {dots + 1, line};
        break;
      case '\n':
        ++line;
        [[fallthrough]];
      case '=':
      case ',':
      case '[':
      case ']':
      case '{':
      case '}':
        dots = 0;
        break;
      default:
        break;
    }
  }
  return deepest;
}

}  // namespace articular::sim
