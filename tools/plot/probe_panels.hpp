#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/error.hpp"
#include "sim/output/history_column.hpp"
#include "tools/plot/axis_unit.hpp"

/// Which columns of history.csv are drawn, and which of them together.
namespace articular::tools {

/// @throws sim::InputError  at `where`, names the column, where its unit is none
AxisUnit column_unit(const sim::HistoryColumn& column, const sim::Location& where);

/// Whether a word means a column: its name, its first parts up to a dot, or with `*` for any
/// characters a pattern of either. "condyle" means "condyle.force.x", and so does "con*.force".
bool means(std::string_view word, std::string_view column);

/// Numbers of the columns that the words mean, in the order of the words and then of the columns,
/// each once; without words all of them.
/// @throws sim::InputError  where a word means none: names the nearest names
std::vector<std::size_t> chosen_columns(const std::vector<std::string>& names,
                                        const std::vector<std::string>& words);

/// One panel of the page, with its columns: one, or x, y and z of a vector.
struct ProbePanel {
  std::string title;  // "incisor.position"
  std::vector<std::size_t> columns;

  bool operator==(const ProbePanel&) const = default;
};

/// Columns `p.x`, `p.y` and `p.z` of one unit, one after another, become one panel.
/// @param join_vectors  false: every column has a panel of its own, as where runs are compared
std::vector<ProbePanel> probe_panels(const std::vector<sim::HistoryColumn>& columns,
                                     const std::vector<std::size_t>& chosen, bool join_vectors);

/// Whether a panel has the components of a vector: the legend then names x, y and z.
bool has_vector(const std::vector<ProbePanel>& panels);

/// 0, 1 and 2 of "p.x", "p.y" and "p.z"; 0 of any other name.
std::size_t component_of(std::string_view column);

}  // namespace articular::tools
