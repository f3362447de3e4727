#include "tools/plot/plotted_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/base/byte_order_mark.hpp"
#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/base/message_text.hpp"
#include "sim/scenario/csv_table.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

std::string shown(const fs::path& path) { return sim::one_line(path.string()); }

std::ifstream open_history(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  // A device may have no end, and a pipe nobody at the other end.
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw sim::InputError({shown(file)}, "it is no regular file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (stream) return stream;
  if (errno == ENOENT)
    throw sim::InputError({shown(file.parent_path())},
                          "no history.csv here: expected the folder of an `articular run`");
  throw sim::InputError({shown(file)}, fmt::format("cannot be read: {}", std::strerror(errno)));
}

/// A line of a whole file ends; what has no end is still being written, or was cut.
enum class Line { Whole, Torn, None };

Line next_line(std::ifstream& stream, std::string& line, const fs::path& file) {
  const bool is_there = static_cast<bool>(std::getline(stream, line));
  if (stream.bad()) throw sim::SystemError(shown(file) + ": reading failed");
  if (!is_there) return Line::None;
  if (stream.eof()) return Line::Torn;
  if (line.ends_with('\r')) line.pop_back();
  return Line::Whole;
}

std::vector<sim::HistoryColumn> columns_of(std::string_view line) {
  line = sim::without_byte_order_mark(line);
  std::vector<sim::HistoryColumn> columns;
  for (;;) {
    const std::size_t comma = line.find(',');
    columns.push_back(sim::history_column(line.substr(0, comma)));
    if (comma == std::string_view::npos) return columns;
    line.remove_prefix(comma + 1);
  }
}

double value_of(std::string_view cell, const sim::HistoryColumn& column,
                const sim::Location& where) {
  cell = sim::trimmed(cell);
  if (cell.empty()) return kNothing;
  double value = 0;
  const char* const end = cell.data() + cell.size();
  const auto [stop, error] = std::from_chars(cell.data(), end, value);
  if (error == std::errc() && stop == end) return std::isfinite(value) ? value : kNothing;
  return sim::csv_number(cell, column.name, where);  // says what is wrong
}

void read_summary(PlottedRun& run) {
  const fs::path file = run.folder / "summary.json";
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return;
  const auto json = nlohmann::json::parse(sim::file_bytes(file), nullptr, false);
  if (!json.is_object()) return;
  if (const auto it = json.find("outcome"); it != json.end() && it->is_string())
    run.outcome = it->get<std::string>();
  const auto settings = json.find("settings");
  if (settings == json.end() || !settings->is_object()) return;
  if (const auto it = settings->find("analysis"); it != settings->end())
    run.is_static = *it == "static";
  if (const auto it = settings->find("duration_s"); it != settings->end() && it->is_number())
    run.duration = it->get<double>();
}

/// The rows of last values; largest and smallest ones have no place on the time axis.
void read_error_bars(PlottedRun& run) {
  const fs::path file = run.folder / "error_bars.csv";
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return;
  std::size_t column = 0, quantity = 0, value = 0, bar = 0, verdict = 0;
  const auto find = [](const sim::CsvRow& columns, const char* name) {
    const auto at = std::find(columns.fields.begin(), columns.fields.end(), name);
    if (at == columns.fields.end())
      throw sim::InputError(columns.where, fmt::format("expected a column `{}`", name));
    return static_cast<std::size_t>(at - columns.fields.begin());
  };
  const sim::CsvTable table = sim::read_csv(file, "the table of error bars", {shown(run.folder)},
                                            [&](const sim::CsvRow& columns) {
                                              column = find(columns, "column");
                                              quantity = find(columns, "quantity");
                                              value = find(columns, "value");
                                              bar = find(columns, "bar");
                                              verdict = find(columns, "verdict");
                                            });
  for (const sim::CsvRow& row : table.rows) {
    if (row.fields[quantity] != "end" || row.fields[value].empty()) continue;
    LastBar last{sim::history_column(row.fields[column]),
                 sim::csv_number(row.fields[value], "value", row.where),
                 {},
                 row.fields[verdict]};
    if (!row.fields[bar].empty()) last.bar = sim::csv_number(row.fields[bar], "bar", row.where);
    run.bars.push_back(std::move(last));
  }
}

/// The cells that are wanted of one row, by the number of their columns.
class RowReader {
 public:
  RowReader(const PlottedRun& run, std::size_t x, const std::vector<std::size_t>& ys)
      : columns_(run.columns), values_(run.columns.size(), kNothing), wanted_(run.columns.size()) {
    wanted_[x] = true;
    for (const std::size_t y : ys) wanted_[y] = true;
  }

  const std::vector<double>& read(std::string_view line, const sim::Location& where) {
    std::size_t i = 0;
    for (;; ++i) {
      const std::size_t comma = line.find(',');
      if (i < columns_.size() && wanted_[i])
        values_[i] = value_of(line.substr(0, comma), columns_[i], where);
      if (comma == std::string_view::npos) break;
      line.remove_prefix(comma + 1);
    }
    if (i + 1 != columns_.size())
      throw sim::InputError(where, fmt::format("expected {} fields as in the first line, found {}",
                                               columns_.size(), i + 1));
    return values_;
  }

 private:
  const std::vector<sim::HistoryColumn>& columns_;
  std::vector<double> values_;
  std::vector<bool> wanted_;
};

}  // namespace

PlottedRun open_run(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (status.type() == fs::file_type::not_found)
    throw sim::InputError({shown(folder)}, "no such folder");
  if (error) throw sim::InputError({shown(folder)}, "cannot be read: " + error.message());
  if (!fs::is_directory(status))
    throw sim::InputError({shown(folder)}, "expected the folder of a run, this is none");
  PlottedRun run;
  run.folder = folder;
  const fs::path file = folder / "history.csv";
  std::ifstream stream = open_history(file);
  std::string line;
  if (next_line(stream, line, file) != Line::Whole)
    throw sim::InputError({shown(file)}, "holds no row of results yet");
  run.columns = columns_of(line);
  if (run.columns.front() != sim::HistoryColumn{"time", "s"})
    throw sim::InputError({shown(file), 1},
                          fmt::format("expected `time [s]` as the first column, found {}",
                                      sim::in_quotes(line.substr(0, line.find(',')))));
  read_summary(run);
  read_error_bars(run);
  return run;
}

std::optional<std::size_t> find_column(const PlottedRun& run, const std::string& name) {
  for (std::size_t i = 0; i < run.columns.size(); ++i)
    if (run.columns[i].name == name) return i;
  return std::nullopt;
}

AxisUnit unit_of_column(const PlottedRun& run, std::size_t column) {
  return column_unit(run.columns[column], {shown(run.folder / "history.csv"), 1});
}

RunCurves read_curves(const PlottedRun& run, std::size_t x, const std::vector<std::size_t>& ys) {
  const fs::path file = run.folder / "history.csv";
  std::ifstream stream = open_history(file);
  RunCurves result;
  result.curves.resize(ys.size());
  RowReader reader(run, x, ys);
  sim::Location where{shown(file), 1, 0};
  std::string line;
  next_line(stream, line, file);
  for (;;) {
    const Line kind = next_line(stream, line, file);
    result.is_torn = kind == Line::Torn;
    if (kind != Line::Whole) break;
    ++where.line;
    if (sim::trimmed(line).empty()) continue;
    const std::vector<double>& values = reader.read(line, where);
    for (std::size_t c = 0; c < ys.size(); ++c) result.curves[c].add(values[x], values[ys[c]]);
    ++result.rows;
  }
  if (result.rows == 0) throw sim::InputError({shown(file)}, "holds no row of results yet");
  return result;
}

}  // namespace articular::tools
