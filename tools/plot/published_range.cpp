#include "tools/plot/published_range.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/scenario/csv_table.hpp"
#include "tools/plot/probe_panels.hpp"

namespace articular::tools {
namespace {

/// "PROBE" and what follows, of "PROBE=...".
std::pair<std::string, std::string> split_probe(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos) return {"", text};
  return {std::string(sim::trimmed(text.substr(0, at))), text.substr(at + 1)};
}

/// The finite number at the start of `rest`, taken off it.
std::optional<double> take_number(std::string_view& rest) {
  rest = sim::trimmed(rest);
  // "4..7": the two dots end the first number, "4." would take one of them.
  const std::string_view first = rest.substr(0, rest.find(".."));
  double value = 0;
  const char* begin = first.data();
  if (first.starts_with('+')) ++begin;
  const auto [stop, error] = std::from_chars(begin, first.data() + first.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
  return value;
}

BandColumn band_column(const sim::CsvTable& table, std::size_t i) {
  const sim::HistoryColumn header = sim::history_column(table.columns.fields[i]);
  BandColumn column{header.name, column_unit(header, table.columns.where), {}};
  for (const sim::CsvRow& row : table.rows)
    column.values.push_back(column.unit.size *
                            sim::csv_number(row.fields[i], header.name, row.where));
  return column;
}

}  // namespace

Interval parse_interval(const std::string& text, const std::string& option) {
  const auto [probe, range] = split_probe(text);
  const auto refuse = [&](const std::string& why) {
    throw sim::InputError(fmt::format("{} {}: expected [PROBE=]LO..HI UNIT such as \"4..7 mm\"{}",
                                      option, sim::in_quotes(text), why));
  };
  std::string_view rest = range;
  const std::optional<double> low = take_number(rest);
  rest = sim::trimmed(rest);
  if (!low || !rest.starts_with("..")) refuse("");
  rest.remove_prefix(2);
  const std::optional<double> high = take_number(rest);
  if (!high) refuse("");
  if (!(*low < *high)) refuse(", the lower end first");
  Interval interval{probe, *low, *high, {}};
  try {
    interval.unit = axis_unit(rest);
  } catch (const std::invalid_argument& error) {
    refuse(fmt::format(": {}", error.what()));
  }
  interval.low *= interval.unit.size;
  interval.high *= interval.unit.size;
  return interval;
}

bool is_band_table(std::string_view text) { return text.ends_with(".csv"); }

BandTable read_band(const std::string& text) {
  const auto [probe, name] = split_probe(text);
  const std::filesystem::path file = name;
  const sim::CsvTable table =
      sim::read_csv(file, "the band", {"--band"}, [](const sim::CsvRow& columns) {
        if (columns.fields.size() != 3)
          throw sim::InputError(
              columns.where,
              fmt::format("expected three columns such as `time [s],low [mm],high [mm]`, found {}",
                          columns.fields.size()));
      });
  BandTable band{probe, file.stem().string(), band_column(table, 0), band_column(table, 1),
                 band_column(table, 2)};
  if (!(band.low.unit.dimension == band.high.unit.dimension))
    throw sim::InputError(table.columns.where, fmt::format("the lower end is {}, the upper one {}",
                                                           sim::noun_of(band.low.unit.dimension),
                                                           sim::noun_of(band.high.unit.dimension)));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (band.low.values[i] > band.high.values[i])
      throw sim::InputError(table.rows[i].where, "the lower end lies above the upper one");
    if (i > 0 && !(band.x.values[i] > band.x.values[i - 1]))
      throw sim::InputError(table.rows[i].where,
                            fmt::format("column {} has to increase", sim::in_ticks(band.x.name)));
  }
  return band;
}

}  // namespace articular::tools
