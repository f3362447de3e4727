#include "sim/scenario/name_pattern.hpp"

#include <cstddef>

namespace articular::sim {

bool is_pattern(std::string_view name) { return name.find('*') != std::string_view::npos; }

/// What stands for the last `*` grows until the rest fits; none before it needs to be looked at
/// again.
bool fits(std::string_view pattern, std::string_view name) {
  constexpr std::size_t kNone = std::string_view::npos;
  std::size_t p = 0, n = 0, star = kNone, behind = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      behind = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != kNone) {
      p = star + 1;
      n = ++behind;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace articular::sim
