#include "sim/scenario/muscle_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "sim/base/message_text.hpp"
#include "sim/scenario/csv_table.hpp"

namespace articular::sim {
namespace {

constexpr std::string_view kOptimalLength = "optimal_length_mm";

/// The columns of the table and the fields of one of its rows.
class TableRow {
 public:
  TableRow(const std::vector<std::string>& columns, const CsvRow& row)
      : columns_(columns), row_(row) {}

  const std::string& text(std::string_view column) const {
    const auto at = std::find(columns_.begin(), columns_.end(), column) - columns_.begin();
    const std::string& field = row_.fields[static_cast<std::size_t>(at)];
    if (field.empty()) throw InputError(row_.where, fmt::format("column `{}` is empty", column));
    return field;
  }

  /// @param rule  what `is_valid` asks for: "must be positive"
  template <class Condition>
  double number(std::string_view column, Condition is_valid, std::string_view rule) const {
    const std::string& field = text(column);
    const double value = csv_number(field, column, row_.where);
    if (!is_valid(value))
      throw InputError(row_.where, fmt::format("column `{}` {}, found {}", column, rule, field));
    return value;
  }

  /// Nothing where there is no such column, or its field is empty.
  template <class Condition>
  std::optional<double> number_if_given(std::string_view column, Condition is_valid,
                                        std::string_view rule) const {
    const auto at = std::find(columns_.begin(), columns_.end(), column);
    if (at == columns_.end()) return std::nullopt;
    if (row_.fields[static_cast<std::size_t>(at - columns_.begin())].empty()) return std::nullopt;
    return number(column, is_valid, rule);
  }

  double coordinate(std::string_view column) const {
    return number(
        column, [](double) { return true; }, "");
  }

 private:
  const std::vector<std::string>& columns_;
  const CsvRow& row_;
};

MuscleRow read_row(const TableRow& row, const Location& where) {
  MuscleRow muscle;
  muscle.where = where;
  muscle.id = row.text("id");
  muscle.muscle = row.text("muscle");
  muscle.upper_body = row.text("body_upper");
  muscle.lower_body = row.text("body_lower");
  muscle.upper_mm[0] = row.coordinate("ux_mm");
  muscle.upper_mm[1] = row.coordinate("uy_mm");
  muscle.upper_mm[2] = row.coordinate("uz_mm");
  muscle.lower_mm[0] = row.coordinate("lx_mm");
  muscle.lower_mm[1] = row.coordinate("ly_mm");
  muscle.lower_mm[2] = row.coordinate("lz_mm");
  muscle.max_force = row.number(
      "max_force_N", [](double f) { return f > 0; }, "must be positive");
  const std::optional<double> optimal_mm = row.number_if_given(
      kOptimalLength, [](double l) { return l > 0; }, "must be positive");
  if (optimal_mm) muscle.optimal_length = 1e-3 * *optimal_mm;
  muscle.max_length_ratio = row.number(
      "max_over_opt_length", [](double r) { return r > 1; }, "must be greater than 1");
  muscle.tendon_ratio = row.number(
      "tendon_ratio", [](double r) { return r >= 0 && r < 1; },
      "must be at least 0 and less than 1");
  return muscle;
}

void check_columns(const CsvRow& headers) {
  const std::vector<std::string>& columns = headers.fields;
  const Location& where = headers.where;
  const auto count = [&](std::string_view name) {
    const auto n = std::count(columns.begin(), columns.end(), name);
    if (n > 1) throw InputError(where, fmt::format("column `{}` appears twice", name));
    return n;
  };
  for (const char* name :
       {"id", "muscle", "body_upper", "ux_mm", "uy_mm", "uz_mm", "body_lower", "lx_mm", "ly_mm",
        "lz_mm", "max_force_N", "max_over_opt_length", "tendon_ratio"}) {
    if (count(name) == 1) continue;
    const std::string near = nearest_name(name, columns);
    throw InputError(where,
                     fmt::format("column `{}` is missing{}", name,
                                 near.empty() ? "" : fmt::format("; is it `{}`?", one_line(near))));
  }
  // The one column that may be missing: with another unit it would go unnoticed.
  if (count(kOptimalLength) == 1) return;
  for (const std::string& column : columns)
    if (column.starts_with("optimal_length"))
      throw InputError(where, fmt::format("expected optimal lengths in millimetres, in a column "
                                          "`{}`, found `{}`",
                                          kOptimalLength, one_line(column)));
}

}  // namespace

std::vector<MuscleRow> read_muscle_table(const std::filesystem::path& file,
                                         const Location& reference) {
  const CsvTable table = read_csv(file, "the muscle table", reference, check_columns);
  std::vector<MuscleRow> rows;
  for (const CsvRow& row : table.rows)
    rows.push_back(read_row(TableRow(table.columns.fields, row), row.where));
  return rows;
}

}  // namespace articular::sim
