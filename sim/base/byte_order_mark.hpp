#pragma once

#include <string_view>

namespace articular::sim {

/// The beginning of a text without the mark that editors on Windows put before it in UTF-8.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

}  // namespace articular::sim
