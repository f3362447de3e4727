#include "sim/output/history_column.hpp"

#include "sim/base/message_text.hpp"

namespace articular::sim {

HistoryColumn history_column(std::string_view text) {
  text = trimmed(text);
  const std::size_t at = text.rfind(" [");
  if (at == std::string_view::npos || !text.ends_with(']')) return {std::string(text), ""};
  return {std::string(text.substr(0, at)), std::string(text.substr(at + 2, text.size() - at - 3))};
}

}  // namespace articular::sim
