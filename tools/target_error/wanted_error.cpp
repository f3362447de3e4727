#include "tools/target_error/wanted_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string_view>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/output/history_column.hpp"
#include "sim/scenario/quantity.hpp"

namespace articular::tools {
namespace {

constexpr const char* kOption = "--target-error";

/// A share of less than this part of the largest component would be one of round-off.
constexpr double kNothing = 1e-6;

std::string unit_of(const std::string& column) { return sim::history_column(column).unit; }

std::string without_unit(const std::string& column) { return sim::history_column(column).name; }

std::string probe_of(const std::string& column) {
  const std::string name = without_unit(column);
  const std::size_t dot = name.find('.');
  return name.substr(0, dot);
}

[[noreturn]] void fail(const WantedError& error, const std::string& what) {
  throw sim::InputError(fmt::format("{} \"{}\": {}", kOption, error.text, what));
}

/// The words after the last colon, where they say which value.
std::optional<Quantity> take_quantity(std::string& text) {
  for (const Quantity quantity : {Quantity::End, Quantity::Largest, Quantity::Smallest}) {
    const std::string ending = std::string(":") + name_of(quantity);
    if (!text.ends_with(ending)) continue;
    text.resize(text.size() - ending.size());
    return quantity;
  }
  return {};
}

[[noreturn]] void fail_of_unknown(const std::string& text,
                                  const std::vector<std::string>& columns) {
  if (columns.empty())
    throw sim::InputError(fmt::format(
        "--of \"{}\": the scenario has no [[probe]], so there is no result to aim at", text));
  const bool is_column = text.find('.') != std::string::npos;
  std::set<std::string> names;
  for (const std::string& column : columns)
    names.insert(is_column ? without_unit(column) : probe_of(column));
  throw sim::InputError(fmt::format("--of \"{}\": there is no such {}{}", text,
                                    is_column ? "result" : "probe",
                                    sim::suggestion(text, {names.begin(), names.end()})));
}

bool is_coordinate(const std::string& column) {
  const std::string name = without_unit(column);
  const bool is_component =
      name.size() > 2 && name[name.size() - 2] == '.' && name.back() >= 'x' && name.back() <= 'z';
  const std::string unit = unit_of(column);
  try {
    return is_component && sim::parse_any_unit(unit).dimension == sim::kLength.dimension;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// Largest less smallest value.
double way_of(const RunHistory& history, const std::string& column) {
  return quantity_value(history, column, Quantity::Largest) -
         quantity_value(history, column, Quantity::Smallest);
}

double amount_in(const WantedError& error, const std::string& column) {
  const std::string unit = unit_of(column);
  if (unit == "-" || error.unit.empty()) {
    if (unit == "-" && error.unit.empty()) return error.number;
    fail(error, unit == "-"
                    ? fmt::format("`{}` has no unit; expected a number such as 0.01, or 2%", column)
                    : fmt::format("it needs a unit, as `{}` has one: \"{} {}\"; or a share, 2%",
                                  column, error.text, unit));
  }
  try {
    const sim::MeasuredUnit given = sim::parse_any_unit(error.unit);
    const sim::MeasuredUnit own = sim::parse_any_unit(unit);
    if (given.dimension == own.dimension) return error.number * given.size / own.size;
  } catch (const std::invalid_argument& problem) {
    fail(error, problem.what());
  }
  fail(error, fmt::format("`{}` is in {}, which is no measure of that kind", column, unit));
}

}  // namespace

WantedError wanted_error(const std::string& text) {
  WantedError error;
  error.text = text;
  char* rest = nullptr;
  error.number = std::strtod(text.c_str(), &rest);
  std::string_view unit = rest;
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  error.is_share = unit == "%";
  if (rest == text.c_str() || !std::isfinite(error.number))
    fail(error, "expected a share such as 2%, or an amount with its unit such as \"0.05 mm\"");
  if (!(error.number > 0)) fail(error, "expected a number above 0");
  if (error.is_share) {
    error.number /= 100;
    if (error.number >= 1) fail(error, "expected less than 100 %");
  } else {
    error.unit = unit;
  }
  return error;
}

WantedResult wanted_result(const std::string& text, const std::vector<std::string>& columns) {
  WantedResult result;
  std::string name = text;
  if (const auto quantity = take_quantity(name)) result.quantity = *quantity;
  std::vector<std::string> of_probe;
  for (const std::string& column : columns) {
    if (column == name || without_unit(column) == name) {
      result.column = column;
      return result;
    }
    if (column.starts_with(name + ".")) of_probe.push_back(column);
  }
  if (of_probe.empty()) fail_of_unknown(name, columns);
  if (of_probe.size() > 1) {
    std::transform(of_probe.begin(), of_probe.end(), of_probe.begin(), without_unit);
    throw sim::InputError(fmt::format("--of \"{}\": expected one of its results: {}", name,
                                      fmt::join(of_probe, ", ")));
  }
  result.column = of_probe.front();
  return result;
}

std::string name_of(const WantedResult& result) {
  const char* const where = result.quantity == Quantity::End       ? "at the end"
                            : result.quantity == Quantity::Largest ? "at its largest"
                                                                   : "at its smallest";
  return fmt::format("`{}` {}", result.column, where);
}

ErrorGoal error_goal(const WantedError& error, const WantedResult& result,
                     const RunHistory& history) {
  const double value = quantity_value(history, result.column, result.quantity);
  if (!std::isfinite(value))
    throw sim::InputError(
        fmt::format("{} has no value in this scene: there is nothing to aim at", name_of(result)));
  if (!error.is_share) return {amount_in(error, result.column), kNoValue, ""};
  const bool is_way = is_coordinate(result.column);
  const double scale = is_way ? way_of(history, result.column) : std::abs(value);
  if (!(scale > kNothing * scale_of(history, result.column)))
    throw sim::InputError(fmt::format(
        "{} {}: {} of nothing can't be aimed at; take another result, or say an amount, such as "
        "{} \"0.01 {}\"",
        name_of(result), is_way ? "does not move" : "is zero", error.text, kOption,
        unit_of(result.column)));
  return {error.number * scale, scale,
          fmt::format("{}, {:.4g} {}", is_way ? "of how far it goes" : "of its size", scale,
                      unit_of(result.column))};
}

}  // namespace articular::tools
