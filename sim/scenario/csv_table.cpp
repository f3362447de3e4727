#include "sim/scenario/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>

#include "sim/base/byte_order_mark.hpp"
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

}  // namespace

CsvTable read_csv(const std::filesystem::path& file, std::string_view what,
                  const Location& reference, const std::function<void(const CsvRow&)>& check) {
  const auto refuse = [&](std::string_view why) {
    throw InputError(reference,
                     fmt::format("cannot read {} {}: {}", what, one_line(file.string()), why));
  };
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (std::filesystem::is_directory(status)) refuse("it is a folder");
  // A device may have no end, and a pipe nobody at the other end.
  if (std::filesystem::is_other(status)) refuse("it is no regular file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(std::strerror(errno));
  CsvTable table;
  Location where{file.string(), 0, 0};
  for (std::string line; std::getline(stream, line);) {
    ++where.line;
    if (line.ends_with('\r')) line.pop_back();
    if (where.line == 1) line = without_byte_order_mark(line);
    if (trimmed(line).empty()) continue;
    std::vector<std::string> fields = split_fields(line, where);
    if (table.columns.fields.empty()) {
      table.columns = {std::move(fields), where};
      check(table.columns);
      continue;
    }
    if (fields.size() != table.columns.fields.size())
      throw InputError(where, fmt::format("expected {} fields as in the first line, found {}",
                                          table.columns.fields.size(), fields.size()));
    table.rows.push_back({std::move(fields), where});
  }
  if (table.rows.empty()) throw InputError({file.string()}, fmt::format("{} has no rows", what));
  return table;
}

double csv_number(std::string_view field, std::string_view column, const Location& where) {
  if (field.empty()) throw InputError(where, fmt::format("column `{}` is empty", one_line(column)));
  double value = 0;
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    throw InputError(where, fmt::format("column `{}`: expected a number, found {}",
                                        one_line(column), in_quotes(field)));
  return value;
}

}  // namespace articular::sim
