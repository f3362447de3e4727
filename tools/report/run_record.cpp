#include "tools/report/run_record.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/scenario/csv_table.hpp"
#include "tools/plot/plotted_run.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

struct Samples {
  std::vector<double> x, y;  // y is NaN where a curve has a gap
};

Samples samples_of(const ThinnedCurve& curve) {
  Samples samples;
  for (const std::vector<PlotPoint>& piece : curve.pieces()) {
    if (!samples.x.empty() && !piece.empty()) {
      samples.x.push_back(0.5 * (samples.x.back() + piece.front().x));
      samples.y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    for (const PlotPoint& point : piece) {
      samples.x.push_back(point.x);
      samples.y.push_back(point.y);
    }
  }
  return samples;
}

/// What stands below the curves: time, or in a static analysis how much of the load acts.
Json time_axis(const PlottedRun& run, double last) {
  if (run.is_static && run.duration > 0)
    return {{"label", "load [%]"}, {"factor", 100 / run.duration}};
  const ShownUnit unit = shown_unit(unit_of_column(run, 0), last);
  return {{"label", "time [" + unit.text + "]"}, {"factor", unit.factor}};
}

std::vector<std::size_t> all_but_the_first(std::size_t count) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 1; i < count; ++i) numbers.push_back(i);
  return numbers;
}

/// Those of `articular render` and `articular plot`, and what else a user put there.
std::vector<fs::path> picture_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::path& place : {folder / "render", folder / "plot"}) {
    std::error_code error;
    for (fs::directory_iterator entry(place, error), end; !error && entry != end;
         entry.increment(error)) {
      const std::string ending = entry->path().extension().string();
      if (is_file(entry->path()) && (ending == ".png" || ending == ".svg"))
        files.push_back(entry->path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Json summary_of(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  if (!is_file(file)) return nullptr;
  Json summary = Json::parse(sim::file_bytes(file), nullptr, false);
  if (!summary.is_object()) throw sim::InputError({file.string()}, "this is no JSON object");
  return summary;
}

Json error_bars_of(const fs::path& folder) {
  const fs::path file = folder / "error_bars.csv";
  if (!is_file(file)) return nullptr;
  const sim::CsvTable table =
      sim::read_csv(file, "the table of error bars", {folder.string()}, [](const sim::CsvRow&) {});
  Json json = {{"columns", table.columns.fields}, {"rows", Json::array()}};
  for (const sim::CsvRow& row : table.rows) json["rows"].push_back(row.fields);
  return json;
}

Json history_of(const fs::path& folder) {
  const PlottedRun run = open_run(folder);
  const std::vector<std::size_t> shown = all_but_the_first(run.columns.size());
  const RunCurves read = read_curves(run, 0, shown);

  Json json = {{"axes", Json::array()}, {"columns", Json::array()}, {"panels", Json::array()}};
  std::map<std::vector<double>, std::size_t> axes;
  std::vector<double> largest(run.columns.size());
  for (std::size_t c = 0; c < shown.size(); ++c) {
    const Samples samples = samples_of(read.curves[c]);
    const auto [axis, is_new] = axes.emplace(samples.x, axes.size());
    if (is_new) json["axes"].push_back(packed_doubles(samples.x));
    largest[shown[c]] = largest_size(samples.y);
    const sim::HistoryColumn& column = run.columns[shown[c]];
    json["columns"].push_back({{"name", column.name},
                               {"unit", column.unit},
                               {"axis", axis->second},
                               {"values", packed_doubles(samples.y)}});
  }
  for (const ProbePanel& panel : probe_panels(run.columns, shown, true)) {
    double most = 0;
    Json columns = Json::array();
    for (const std::size_t column : panel.columns) {
      most = std::max(most, largest[column]);
      columns.push_back(column - 1);
    }
    const ShownUnit unit = shown_unit(unit_of_column(run, panel.columns.front()), most);
    json["panels"].push_back({{"title", panel.title},
                              {"is_zero", most == 0},
                              {"unit", unit.text},
                              {"factor", unit.factor},
                              {"columns", columns}});
  }
  double last = 0;
  for (const auto& [times, number] : axes) last = std::max(last, largest_size(times));
  json["time"] = time_axis(run, last);
  json["rows"] = read.rows;
  return json;
}

Json pictures_of(const fs::path& folder, double room) {
  Json json = {{"pictures", Json::array()}, {"remarks", Json::array()}};
  std::error_code none;
  const auto results = fs::last_write_time(folder / "summary.json", none);
  for (const fs::path& file : picture_files(folder)) {
    const std::string name = file.lexically_relative(folder).string();
    std::error_code ignored;
    if (fs::last_write_time(file, ignored) < results) {
      json["remarks"].push_back(name + " is left out: it was drawn of earlier results");
      continue;
    }
    const auto size = 4.0 / 3 * static_cast<double>(fs::file_size(file, ignored));
    if (size > room) {
      json["remarks"].push_back(name + " is left out, to keep this page small");
      continue;
    }
    room -= size;
    const char* const type = file.extension() == ".svg" ? "image/svg+xml" : "image/png";
    json["pictures"].push_back(
        {{"name", name},
         {"source", std::string("data:") + type + ";base64," + base64(sim::file_bytes(file))}});
  }
  return json;
}

}  // namespace articular::tools
