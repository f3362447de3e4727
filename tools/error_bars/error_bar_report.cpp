#include "tools/error_bars/error_bar_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/study/csv_cell.hpp"

namespace articular::tools {
namespace {

using Json = nlohmann::ordered_json;

/// "1.500" of the size 1.5; "failed".
std::string size_text(const CoarserRun& run) {
  return run.failure.empty() ? fmt::format("{:.3g}", run.size) : "failed";
}

/// What was done for one kind of error.
std::string direction_line(const Direction& direction) {
  std::string line = fmt::format("  {:<10} ", direction.name);
  if (!direction.runs.empty()) {
    line += "sizes 1";
    for (const CoarserRun& run : direction.runs) line += ", " + size_text(run);
  }
  const auto add = [&](const std::string& text) {
    if (!text.empty()) line += (line.ends_with(' ') ? "" : "; ") + text;
  };
  add(direction.remark);
  if (!direction.left_out.empty()) add("not in the bars: " + direction.left_out);
  for (const CoarserRun& run : direction.runs)
    if (!run.failure.empty()) add(fmt::format("`{}` failed: {}", run.name, run.failure));
  return line + "\n";
}

/// A value with the digits that its bar leaves: "12.3" for 12.3456 ± 0.2.
std::string rounded(double value, double bar) {
  if (!(bar > 0) || !std::isfinite(bar)) return fmt::format("{:.6g}", value);
  const int digits = 1 - static_cast<int>(std::floor(std::log10(bar)));  // two of the bar
  if (digits < 0 || digits > 9) return fmt::format("{:.6g}", value);
  return fmt::format("{:.{}f}", value, digits);
}

int count_of(const std::vector<ErrorBar>& bars, const std::string& word) {
  return static_cast<int>(std::count_if(bars.begin(), bars.end(), [&](const ErrorBar& bar) {
    return verdict(bar).starts_with(word);
  }));
}

}  // namespace

std::string verdict(const ErrorBar& bar) {
  if (!bar.is_estimated()) return fmt::format("not estimated ({})", bar.left_out);
  if (bar.is_negligible()) return "negligible";
  return bar.doubts.empty() ? "asymptotic" : fmt::format("not asymptotic ({})", bar.doubts);
}

std::string error_bars_csv(const std::vector<Direction>& directions,
                           const std::vector<ErrorBar>& bars) {
  std::string text = "column,quantity,value,bar";
  for (const Direction& direction : directions)
    text += fmt::format(",{0},order of {0}", direction.name);
  text += ",verdict,not in the bar\n";
  for (const ErrorBar& bar : bars) {
    text += fmt::format("{},{},{},{}", csv_cell(bar.column), name_of(bar.quantity),
                        csv_cell(bar.value, 9), csv_cell(bar.bar, 3));
    for (const DiscretisationError& part : bar.parts)
      text += "," + csv_cell(part.bar, 3) + "," + csv_cell(part.order, 3);
    text += "," + csv_cell(verdict(bar)) + "," + csv_cell(bar.left_out) + "\n";
  }
  return text;
}

std::string error_bars_text(const std::vector<Direction>& directions,
                            const std::vector<ErrorBar>& bars) {
  std::string text =
      "Error bars: the sum of what mesh, step, contact and tolerance may be off by\n";
  for (const Direction& direction : directions) text += direction_line(direction);
  std::size_t width = 6;
  for (const ErrorBar& bar : bars) width = std::max(width, bar.column.size());
  text += fmt::format("\n{:<{}}  {:<8} {:>14}   {:<10} {}\n", "column", width, "quantity", "value",
                      "bar", "verdict");
  for (const ErrorBar& bar : bars) {
    const bool is_partial = bar.is_estimated() && !bar.left_out.empty();
    text += fmt::format("{:<{}}  {:<8} {:>14} {} {:<10} {}{}\n", bar.column, width,
                        name_of(bar.quantity), rounded(bar.value, bar.bar),
                        bar.is_estimated() ? "±" : " ",
                        bar.is_estimated() ? fmt::format("{:.2g}", bar.bar) : "", verdict(bar),
                        is_partial ? "; not all is in the bar" : "");
  }
  return text;
}

std::string summary_with_error_bars(const std::string& summary,
                                    const std::vector<Direction>& directions,
                                    const std::vector<ErrorBar>& bars) {
  Json json = Json::parse(summary);
  Json told = {{"table", "error_bars.csv"}};
  for (const Direction& direction : directions) {
    Json entry = {{"sizes", Json::array({1})}};
    for (const CoarserRun& run : direction.runs) {
      entry["sizes"].push_back(run.failure.empty() ? Json(run.size) : Json(nullptr));
      if (!run.failure.empty()) entry["failed"].push_back({{run.name, run.failure}});
    }
    if (!direction.remark.empty()) entry["remark"] = direction.remark;
    if (!direction.left_out.empty()) entry["not_in_the_bars"] = direction.left_out;
    told[direction.name] = entry;
  }
  told["quantities"] = {{"negligible", count_of(bars, "negligible")},
                        {"asymptotic", count_of(bars, "asymptotic")},
                        {"not_asymptotic", count_of(bars, "not asymptotic")},
                        {"not_estimated", count_of(bars, "not estimated")}};
  json["error_bars"] = told;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace articular::tools
