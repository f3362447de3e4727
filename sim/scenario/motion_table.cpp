#include "sim/scenario/motion_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "sim/base/message_text.hpp"
#include "sim/scenario/csv_table.hpp"
#include "sim/scenario/quantity.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

/// What a column holds: the time, or a freedom.
struct Column {
  std::optional<std::size_t> freedom;
  double unit = 1;  // in SI
};

double read_unit(std::string_view unit, const QuantityKind& kind, const std::string& header,
                 const Location& where) {
  try {
    return parse_unit(unit, kind);
  } catch (const std::invalid_argument& error) {
    throw InputError(where,
                     fmt::format("column {}: {}", in_quotes(header), one_line(error.what())));
  }
}

Column read_column(const std::string& header, const Location& where) {
  std::vector<std::string> names{"time"};
  for (std::size_t i = 0; i < 6; ++i) names.emplace_back(freedom_name(i));
  const std::size_t open = header.find('[');
  const std::string name(trimmed(std::string_view(header).substr(0, open)));
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError(
        where, fmt::format("unknown column {}{}", in_quotes(header), suggestion(name, names)));
  const auto i = static_cast<std::size_t>(found - names.begin());
  const QuantityKind& kind = i == 0 ? kTime : i <= 3 ? kLength : kAngle;
  if (open == std::string::npos || !header.ends_with(']'))
    throw InputError(
        where, fmt::format("column {} has no unit: expected \"{} [{}]\"", in_quotes(header), name,
                           i == 0   ? "s"
                           : i <= 3 ? "mm"
                                    : "deg"));
  const std::string_view unit =
      trimmed(std::string_view(header).substr(open + 1, header.size() - open - 2));
  return {i == 0 ? std::nullopt : std::optional(i - 1), read_unit(unit, kind, header, where)};
}

std::vector<Column> read_columns(const CsvRow& headers) {
  std::vector<Column> columns;
  for (const std::string& header : headers.fields) {
    const Column column = read_column(header, headers.where);
    if (std::any_of(columns.begin(), columns.end(),
                    [&](const Column& other) { return other.freedom == column.freedom; }))
      throw InputError(headers.where, fmt::format("column {} appears twice", in_quotes(header)));
    columns.push_back(column);
  }
  const auto times = std::count_if(columns.begin(), columns.end(),
                                   [](const Column& column) { return !column.freedom; });
  if (times == 0)
    throw InputError(headers.where, "column `time` is missing: expected one called \"time [s]\"");
  if (columns.size() == 1)
    throw InputError(headers.where,
                     "no column moves anything: expected some of \"translation.x [mm]\" to "
                     "\"rotation.z [deg]\"");
  return columns;
}

}  // namespace

MotionTable read_motion_table(const std::filesystem::path& file, const Location& reference) {
  std::vector<Column> columns;
  const CsvTable table = read_csv(file, "the motion", reference,
                                  [&](const CsvRow& headers) { columns = read_columns(headers); });
  MotionTable motion;
  const auto moves = [&](std::size_t first) {
    return std::any_of(columns.begin(), columns.end(), [first](const Column& column) {
      return column.freedom && *column.freedom / 3 == first / 3;
    });
  };
  const bool shifts = moves(0), turns = moves(3);
  for (const CsvRow& row : table.rows) {
    Vec3 parts[2] = {Vec3::Zero(), Vec3::Zero()};
    double time = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto& [freedom, unit] = columns[c];
      const double value = unit * csv_number(row.fields[c], table.columns.fields[c], row.where);
      (freedom ? parts[*freedom / 3][static_cast<Eigen::Index>(*freedom % 3)] : time) = value;
    }
    if (!motion.time.empty() && !(time > motion.time.back()))
      throw InputError(row.where, fmt::format("times must increase, found {:g} s after {:g} s",
                                              time, motion.time.back()));
    motion.time.push_back(time);
    if (shifts) motion.translation.push_back(parts[0]);
    if (turns) motion.rotation.push_back(parts[1]);
    motion.rows.push_back(row.where);
  }
  return motion;
}

}  // namespace articular::sim
