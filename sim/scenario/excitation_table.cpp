#include "sim/scenario/excitation_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sim/scenario/csv_table.hpp"
#include "sim/scenario/curve.hpp"
#include "sim/scenario/data_path.hpp"
#include "sim/scenario/range.hpp"
#include "sim/scenario/scenario_keys.hpp"

namespace articular::sim {
namespace {

constexpr std::string_view kTimeColumn = "time [s]";

/// Which muscle each column is of; none: the time.
using MuscleOfColumn = std::vector<std::optional<std::size_t>>;

MuscleOfColumn muscles_of_columns(const CsvRow& headers, const std::vector<Muscle>& muscles) {
  std::vector<std::string> names{std::string(kTimeColumn)};
  for (const Muscle& muscle : muscles) names.push_back(muscle.name);
  MuscleOfColumn columns;
  for (std::size_t c = 0; c < headers.fields.size(); ++c) {
    const std::string& header = headers.fields[c];
    const auto found = std::find(names.begin(), names.end(), header);
    if (found == names.end())
      throw InputError(headers.where, fmt::format("column {}: the scenario has no such muscle{}",
                                                  in_quotes(header), suggestion(header, names)));
    if (std::count(headers.fields.begin(), headers.fields.end(), header) > 1)
      throw InputError(headers.where, fmt::format("column {} appears twice", in_quotes(header)));
    const auto i = static_cast<std::size_t>(found - names.begin());
    columns.push_back(i == 0 ? std::nullopt : std::optional(i - 1));
  }
  if (std::count(columns.begin(), columns.end(), std::nullopt) == 0)
    throw InputError(headers.where, fmt::format("expected a column \"{}\"", kTimeColumn));
  return columns;
}

double excitation_in(const std::string& field, const std::string& column, const Location& where) {
  const double value = csv_number(field, column, where);
  if (value < 0 || value > 1)
    throw InputError(where, fmt::format("column `{}`: an excitation must lie between 0 and 1, "
                                        "found {:g}",
                                        column, value));
  return value;
}

}  // namespace

const KeyTable& excitations_keys() {
  static const KeyTable kTable{
      "[excitations]",
      {{"file",
        {form::Text{"path"}},
        kRequired,
        "a table (.csv): `time [s]`, and a column for each of some muscles, by name"}}};
  return kTable;
}

std::vector<std::size_t> replace_excitations(const Node* node, const Context& context,
                                             std::vector<Muscle>& muscles) {
  if (node == nullptr) return {};
  const TableReader reader(*node, excitations_keys(), "[excitations]");
  const Node& file = reader.at("file");
  MuscleOfColumn muscle;
  const CsvTable table =
      read_csv(read_path(file, context.folder), "the table of excitations", file.where,
               [&](const CsvRow& headers) { muscle = muscles_of_columns(headers, muscles); });
  std::vector<std::size_t> replaced;
  for (const std::optional<std::size_t>& m : muscle)
    if (m) replaced.push_back(*m);
  for (const std::size_t m : replaced) muscles[m].excitation = {};
  const auto time = static_cast<std::size_t>(std::find(muscle.begin(), muscle.end(), std::nullopt) -
                                             muscle.begin());
  std::optional<double> before;
  for (const CsvRow& row : table.rows) {
    const double t = csv_number(row.fields[time], kTimeColumn, row.where);
    if (before && !(t > *before))
      throw InputError(row.where,
                       fmt::format("times must increase, found {:g} s after {:g} s", t, *before));
    before = t;
    for (std::size_t c = 0; c < muscle.size(); ++c) {
      if (!muscle[c]) continue;
      Curve& curve = muscles[*muscle[c]].excitation;
      curve.time.push_back(t);
      curve.value.push_back(excitation_in(row.fields[c], table.columns.fields[c], row.where));
    }
  }
  return replaced;
}

std::string late_excitation_doubt(const Node* node, const std::vector<Muscle>& muscles,
                                  const std::vector<std::size_t>& replaced, double duration) {
  for (const std::size_t m : replaced)
    if (changes_after(muscles[m].excitation, duration))
      return prefix(node->where) +
             fmt::format(
                 "the excitation of `{}` changes until {:.6g} s, and the run ends at "
                 "{:.6g} s: what comes later is not computed",
                 muscles[m].name, muscles[m].excitation.time.back(), duration);
  return "";
}

}  // namespace articular::sim
