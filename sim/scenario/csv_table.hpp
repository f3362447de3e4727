#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/error.hpp"

namespace articular::sim {

/// Fields of one line of a table, and where that is.
struct CsvRow {
  std::vector<std::string> fields;
  Location where;
};

/// Comma separated values: the first line names the columns.
struct CsvTable {
  CsvRow columns;
  std::vector<CsvRow> rows;  // with as many fields as they have; at least one
};

/// Fields may be quoted; empty lines, carriage returns and a byte order mark are left out.
/// @param what       for messages: "the muscle table"
/// @param reference  where the file is named: told if it cannot be read
/// @param check      throws where the columns are not those of such a table, before any row is read
/// @throws InputError with file:line
CsvTable read_csv(const std::filesystem::path& file, std::string_view what,
                  const Location& reference, const std::function<void(const CsvRow&)>& check);

/// The finite number that a field is. @throws InputError naming the column
double csv_number(std::string_view field, std::string_view column, const Location& where);

}  // namespace articular::sim
