#pragma once

namespace articular::sim {

/// Of mesh files, whatever the user's locale says.
inline bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

}  // namespace articular::sim
