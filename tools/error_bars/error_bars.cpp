#include "tools/error_bars/error_bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "sim/base/error.hpp"
#include "sim/output/history_column.hpp"

namespace articular::tools {
namespace {

/// Of the scale: what equilibrium is found to, and far above round-off.
constexpr double kNegligible = 1e-6;

/// What is less of the bar than this may be uncertain itself.
constexpr double kMuchOfTheBar = 0.1;

/// The rows between which a column has values; empty: it has none.
std::vector<std::size_t> rows_with_values(const std::vector<double>& column) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < column.size(); ++i)
    if (std::isfinite(column[i])) rows.push_back(i);
  return rows;
}

/// What a column is quoted by.
std::vector<Quantity> quantities_of(const std::vector<double>& column) {
  const std::vector<std::size_t> rows = rows_with_values(column);
  if (rows.empty()) return {};
  std::vector<Quantity> quantities;
  if (rows.back() + 1 == column.size()) quantities.push_back(Quantity::End);
  const auto below = [&](std::size_t a, std::size_t b) { return column[a] < column[b]; };
  const auto [least, most] = std::minmax_element(rows.begin(), rows.end(), below);
  const double first = column[rows.front()], last = column[rows.back()];
  if (column[*most] > std::max(first, last)) quantities.push_back(Quantity::Largest);
  if (column[*least] < std::min(first, last)) quantities.push_back(Quantity::Smallest);
  return quantities;
}

/// What the components of a vector share: "tip.force [N]" of "tip.force.x [N]".
sim::HistoryColumn stem_of(const std::string& text) {
  sim::HistoryColumn column = sim::history_column(text);
  for (const std::string_view axis : {".x", ".y", ".z"})
    if (column.name.ends_with(axis)) {
      column.name.resize(column.name.size() - axis.size());
      break;
    }
  return column;
}

void append(std::string& list, const std::string& text) {
  list += (list.empty() ? "" : "; ") + text;
}

/// The part of one direction, and what of it is missing.
DiscretisationError part_of(const Direction& direction, ErrorBar& bar) {
  std::vector<SizedValue> values{{1, bar.value}};
  std::string failures;
  for (const CoarserRun& run : direction.runs) {
    if (run.failure.empty())
      values.push_back({run.size, quantity_value(run.history, bar.column, bar.quantity)});
    else
      append(failures, fmt::format("the coarser run `{}` failed", run.name));
  }
  if (!direction.left_out.empty()) append(bar.left_out, direction.name + ": " + direction.left_out);
  if (direction.runs.empty()) return {};
  DiscretisationError error = discretisation_error(values, direction.formal_order);
  if (!std::isfinite(error.bar))
    append(bar.left_out, direction.name + ": " + (failures.empty() ? error.doubt : failures));
  else if (!failures.empty())
    append(error.doubt, failures);
  return error;
}

bool is_doubted(const Direction& direction, const DiscretisationError& part) {
  return !part.doubt.empty() && direction.wanted_runs > 1;
}

void sum_up(const std::vector<Direction>& directions, ErrorBar& bar) {
  double sum = 0, doubted = 0;
  bool any = bar.left_out.empty();  // a scene may have no such error at all
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const DiscretisationError& part = bar.parts[d];
    if (!std::isfinite(part.bar)) {
      if (directions[d].is_needed) return;
      continue;
    }
    any = true;
    sum += part.bar;
    if (is_doubted(directions[d], part)) doubted += part.bar;
  }
  if (!any) return;
  bar.bar = sum;
  if (doubted <= kMuchOfTheBar * sum) return;
  for (std::size_t d = 0; d < directions.size(); ++d)
    if (is_doubted(directions[d], bar.parts[d]) && bar.parts[d].bar > kMuchOfTheBar * sum / 2)
      append(bar.doubts, directions[d].name + ": " + bar.parts[d].doubt);
}

}  // namespace

bool ErrorBar::is_negligible() const { return is_estimated() && bar <= kNegligible * scale; }

const char* name_of(Quantity quantity) {
  constexpr const char* kNames[] = {"end", "largest", "smallest"};
  return kNames[static_cast<int>(quantity)];
}

double quantity_value(const RunHistory& history, const std::string& column, Quantity quantity) {
  const auto name = std::find(history.names.begin(), history.names.end(), column);
  if (name == history.names.end())
    throw sim::InputError(fmt::format("a coarser run has no column `{}`", column));
  const auto& values = history.columns[static_cast<std::size_t>(name - history.names.begin())];
  if (quantity == Quantity::End) return values.back();
  double extreme = kNoValue;
  for (const double value : values) {
    const bool is_farther = quantity == Quantity::Largest ? value > extreme : value < extreme;
    if (std::isnan(extreme) || is_farther) extreme = value;
  }
  return extreme;
}

double scale_of(const RunHistory& history, const std::string& column) {
  double most = 0;
  for (std::size_t c = 1; c < history.names.size(); ++c)
    if (stem_of(history.names[c]) == stem_of(column))
      for (const double value : history.columns[c])
        if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

void add_force_sizes(RunHistory& history) {
  constexpr std::string_view kFirst = ".force.x [N]";
  const std::size_t given = history.names.size();
  for (std::size_t c = 0; c + 2 < given; ++c) {
    const std::string& name = history.names[c];
    if (!name.ends_with(kFirst)) continue;
    const auto &x = history.columns[c], &y = history.columns[c + 1], &z = history.columns[c + 2];
    std::vector<double> sizes;
    for (std::size_t i = 0; i < x.size(); ++i) sizes.push_back(std::hypot(x[i], y[i], z[i]));
    history.names.push_back(name.substr(0, name.size() - kFirst.size()) + ".force [N]");
    history.columns.push_back(std::move(sizes));
  }
}

std::vector<ErrorBar> error_bars(const RunHistory& history,
                                 const std::vector<Direction>& directions) {
  std::vector<ErrorBar> bars;
  for (std::size_t c = 1; c < history.names.size(); ++c)  // after the time
    for (const Quantity quantity : quantities_of(history.columns[c])) {
      ErrorBar bar;
      bar.column = history.names[c];
      bar.quantity = quantity;
      bar.value = quantity_value(history, bar.column, quantity);
      bar.scale = scale_of(history, bar.column);
      for (const Direction& direction : directions) bar.parts.push_back(part_of(direction, bar));
      sum_up(directions, bar);
      bars.push_back(std::move(bar));
    }
  return bars;
}

}  // namespace articular::tools
