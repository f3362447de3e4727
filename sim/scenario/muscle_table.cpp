#include "sim/scenario/muscle_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include "sim/base/message_text.hpp"

namespace articular::sim {
namespace {

/// The fields of one line: `a, "b, c", "say ""d"""` -> a | b, c | say "d".
std::vector<std::string> split_fields(std::string_view line, const Location& where) {
  std::vector<std::string> fields;
  for (std::string_view rest = line;;) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    std::string field;
    if (rest.starts_with('"')) {
      rest.remove_prefix(1);
      for (;;) {
        const std::size_t quote = rest.find('"');
        if (quote == std::string_view::npos)
          throw InputError(where, "a quoted field has no closing `\"`");
        field += rest.substr(0, quote);
        rest.remove_prefix(quote + 1);
        if (!rest.starts_with('"')) break;
        field += '"';
        rest.remove_prefix(1);
      }
      if (!trimmed(rest.substr(0, rest.find(','))).empty())
        throw InputError(where, "expected a comma after the quoted field " + in_quotes(field));
    } else {
      field = trimmed(rest.substr(0, rest.find(',')));
    }
    fields.push_back(field);
    const std::size_t comma = rest.find(',');
    if (comma == std::string_view::npos) return fields;
    rest.remove_prefix(comma + 1);
  }
}

/// The columns of the table and the fields of one of its rows.
class Row {
 public:
  Row(const std::vector<std::string>& columns, std::vector<std::string> fields, Location where)
      : columns_(columns), fields_(std::move(fields)), where_(std::move(where)) {
    if (fields_.size() != columns_.size())
      throw InputError(where_, fmt::format("expected {} fields as in the first line, found {}",
                                           columns_.size(), fields_.size()));
  }

  const std::string& text(std::string_view column) const {
    const auto at = std::find(columns_.begin(), columns_.end(), column) - columns_.begin();
    const std::string& field = fields_[static_cast<std::size_t>(at)];
    if (field.empty()) throw InputError(where_, fmt::format("column `{}` is empty", column));
    return field;
  }

  /// @param rule  what `is_valid` asks for: "must be positive"
  template <class Condition>
  double number(std::string_view column, Condition is_valid, std::string_view rule) const {
    const std::string& field = text(column);
    double value = 0;
    const char* end = field.data() + field.size();
    const auto [stop, error] = std::from_chars(field.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value))
      throw InputError(where_, fmt::format("column `{}`: expected a number, found {}", column,
                                           in_quotes(field)));
    if (!is_valid(value))
      throw InputError(where_, fmt::format("column `{}` {}, found {}", column, rule, field));
    return value;
  }

  double coordinate(std::string_view column) const {
    return number(
        column, [](double) { return true; }, "");
  }

 private:
  const std::vector<std::string>& columns_;
  std::vector<std::string> fields_;
  Location where_;
};

MuscleRow read_row(const Row& row, const Location& where) {
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
  muscle.max_length_ratio = row.number(
      "max_over_opt_length", [](double r) { return r > 1; }, "must be greater than 1");
  muscle.tendon_ratio = row.number(
      "tendon_ratio", [](double r) { return r >= 0 && r < 1; },
      "must be at least 0 and less than 1");
  return muscle;
}

void check_columns(const std::vector<std::string>& columns, const Location& where) {
  for (const char* name :
       {"id", "muscle", "body_upper", "ux_mm", "uy_mm", "uz_mm", "body_lower", "lx_mm", "ly_mm",
        "lz_mm", "max_force_N", "max_over_opt_length", "tendon_ratio"}) {
    const auto count = std::count(columns.begin(), columns.end(), name);
    if (count == 1) continue;
    if (count > 1) throw InputError(where, fmt::format("column `{}` appears twice", name));
    const std::string near = nearest_name(name, columns);
    throw InputError(where, fmt::format("column `{}` is missing{}", name,
                                        near.empty() ? "" : fmt::format("; is it `{}`?", near)));
  }
}

}  // namespace

std::vector<MuscleRow> read_muscle_table(const std::filesystem::path& file,
                                         const Location& reference) {
  std::error_code ignored;
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file, ignored))
    throw InputError(reference, fmt::format("cannot read the muscle table {}: {}", file.string(),
                                            errno != 0 ? std::strerror(errno) : "it is a folder"));
  std::vector<std::string> columns;
  std::vector<MuscleRow> rows;
  Location where{file.string(), 0, 0};
  for (std::string line; std::getline(stream, line);) {
    ++where.line;
    if (line.ends_with('\r')) line.pop_back();
    if (where.line == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark
    if (trimmed(line).empty()) continue;
    std::vector<std::string> fields = split_fields(line, where);
    if (columns.empty()) {
      check_columns(fields, where);
      columns = std::move(fields);
    } else {
      rows.push_back(read_row(Row(columns, std::move(fields), where), where));
    }
  }
  if (rows.empty()) throw InputError({file.string()}, "the muscle table has no rows");
  return rows;
}

}  // namespace articular::sim
