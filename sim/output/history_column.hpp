#pragma once

#include <string>
#include <string_view>

namespace articular::sim {

/// A column as the first line of history.csv names it.
struct HistoryColumn {
  std::string name;  // "incisor.position.z"
  std::string unit;  // "mm"; "" where the line has none

  bool operator==(const HistoryColumn&) const = default;
};

/// @param text  "incisor.position.z [mm]"
HistoryColumn history_column(std::string_view text);

}  // namespace articular::sim
