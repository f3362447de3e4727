#pragma once

#include <algorithm>
#include <string>

namespace articular::sim {

/// Whether a message is one line that a terminal shows as it is.
inline bool is_readable_line(const std::string& message) {
  return !message.empty() && std::none_of(message.begin(), message.end(), [](char c) {
    return (c >= 0 && c < ' ') || c == '\x7f';
  });
}

}  // namespace articular::sim
