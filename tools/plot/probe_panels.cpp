#include "tools/plot/probe_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/scenario/name_pattern.hpp"

namespace articular::tools {
namespace {

/// "a", "a.b" and "a.b.c" of "a.b.c".
std::vector<std::string> parts_of(std::string_view name) {
  std::vector<std::string> parts;
  for (std::size_t dot = name.find('.'); dot != std::string_view::npos;
       dot = name.find('.', dot + 1))
    parts.emplace_back(name.substr(0, dot));
  parts.emplace_back(name);
  return parts;
}

[[noreturn]] void refuse(const std::string& word, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const std::string& name : names)
    for (const std::string& part : parts_of(name))
      if (std::find(known.begin(), known.end(), part) == known.end()) known.push_back(part);
  const bool is_path = word.find('/') != std::string::npos;
  throw sim::InputError(
      is_path ? fmt::format("{} is neither a folder of a run nor a probe", sim::in_quotes(word))
              : fmt::format("no run has a probe {}{}", sim::in_quotes(word),
                            sim::suggestion(word, known)));
}

}  // namespace

AxisUnit column_unit(const sim::HistoryColumn& column, const sim::Location& where) try {
  return axis_unit(column.unit);
} catch (const std::invalid_argument& error) {
  throw sim::InputError(where,
                        fmt::format("column {}: {}", sim::in_ticks(column.name), error.what()));
}

bool means(std::string_view word, std::string_view column) {
  const std::vector<std::string> parts = parts_of(column);
  return std::any_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return sim::fits(word, part); });
}

std::vector<std::size_t> chosen_columns(const std::vector<std::string>& names,
                                        const std::vector<std::string>& words) {
  std::vector<std::size_t> chosen;
  const auto choose = [&](std::size_t i) {
    if (std::find(chosen.begin(), chosen.end(), i) == chosen.end()) chosen.push_back(i);
  };
  for (const std::string& word : words) {
    bool is_known = false;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (means(word, names[i])) {
        choose(i);
        is_known = true;
      }
    if (!is_known) refuse(word, names);
  }
  if (words.empty())
    for (std::size_t i = 0; i < names.size(); ++i) choose(i);
  return chosen;
}

std::vector<ProbePanel> probe_panels(const std::vector<sim::HistoryColumn>& columns,
                                     const std::vector<std::size_t>& chosen, bool join_vectors) {
  std::vector<ProbePanel> panels;
  const auto is_component = [&](std::size_t i, const std::string& stem, char axis) {
    return i < chosen.size() && columns[chosen[i]].name == stem + "." + axis;
  };
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const sim::HistoryColumn& column = columns[chosen[i]];
    const std::string stem = column.name.substr(0, column.name.rfind('.'));
    const bool is_vector = join_vectors && is_component(i, stem, 'x') &&
                           is_component(i + 1, stem, 'y') && is_component(i + 2, stem, 'z') &&
                           columns[chosen[i + 1]].unit == column.unit &&
                           columns[chosen[i + 2]].unit == column.unit;
    if (is_vector) {
      panels.push_back({stem, {chosen[i], chosen[i + 1], chosen[i + 2]}});
      i += 2;
    } else {
      panels.push_back({column.name, {chosen[i]}});
    }
  }
  return panels;
}

bool has_vector(const std::vector<ProbePanel>& panels) {
  return std::any_of(panels.begin(), panels.end(),
                     [](const ProbePanel& panel) { return panel.columns.size() == 3; });
}

std::size_t component_of(std::string_view column) {
  if (column.ends_with(".y")) return 1;
  return column.ends_with(".z") ? 2 : 0;
}

}  // namespace articular::tools
