#include "tools/target_error/target_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/output/history_column.hpp"

namespace articular::tools {
namespace {

using Json = nlohmann::ordered_json;

/// NaN has no place in JSON.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string course_line(const ErrorCourse& course, const Refinement& kind) {
  if (course.points.size() < 2) {
    const std::string why =
        kind.coarser.left_out.empty() ? kind.coarser.remark : kind.coarser.left_out;
    return fmt::format("  {:<10} not varied: {}\n", course.name, why);
  }
  std::string sizes;
  for (const SizedValue& point : course.points)
    sizes += fmt::format("{}{:.3g}", sizes.empty() ? "" : ", ", point.size / course.size());
  const DiscretisationError error = error_of(course);
  std::string order = std::isfinite(error.order) ? fmt::format("order {:.2g}", error.order) : "";
  if (!error.doubt.empty()) order += (order.empty() ? "" : ", ") + error.doubt;
  return fmt::format("  {:<10} {:<10.2g} sizes {}{}{}\n", course.name, error.bar, sizes,
                     order.empty() ? "" : "; ", order);
}

}  // namespace

double bar_of(const std::vector<ErrorCourse>& courses) {
  double sum = 0;
  for (const ErrorCourse& course : courses) sum += error_of(course).bar;
  return sum;
}

double bar_if_confirmed(const std::vector<ErrorCourse>& courses) {
  double sum = 0;
  for (const ErrorCourse& course : courses) sum += confirmed_bar(course);
  return sum;
}

std::string parts_text(const std::vector<ErrorCourse>& courses) {
  constexpr double kCounts = 0.01;
  const double sum = bar_of(courses);
  std::string text;
  for (const ErrorCourse& course : courses)
    if (const double bar = error_of(course).bar; bar > kCounts * sum)
      text += fmt::format("{}{} {:.2g}", text.empty() ? "" : ", ", course.name, bar);
  return text;
}

std::string left_out_text(const std::vector<Refinement>& kinds) {
  std::string text;
  for (const Refinement& kind : kinds)
    if (!kind.coarser.left_out.empty())
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", kind.coarser.name,
                          kind.coarser.left_out);
  return text;
}

std::string error_text(double error, const TargetRecord& record) {
  if (record.wanted.is_share) return fmt::format("{:.2g} %", 100 * error / record.goal.scale);
  return fmt::format("{:.2g} {}", error, sim::history_column(record.result.column).unit);
}

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.2g} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 360000) return fmt::format("{:.1f} h", seconds / 3600);
  return fmt::format("{:.0f} days", seconds / 86400);
}

std::string target_text(const TargetRecord& record) {
  const std::string unit = sim::history_column(record.result.column).unit;
  std::string text =
      fmt::format("{}: {:.6g} ± {:.2g} {}", name_of(record.result), record.value, record.bar, unit);
  if (record.wanted.is_share)
    text += fmt::format(", that is {} {}", error_text(record.bar, record), record.goal.of);
  text += fmt::format("; {} {}\n", record.wanted.text, record.is_met ? "is met" : "is not met");
  text += fmt::format("\nparts of the error [{}], and the sizes that they were seen with\n", unit);
  for (std::size_t i = 0; i < record.courses.size(); ++i)
    text += course_line(record.courses[i], record.kinds[i]);
  if (const std::string left_out = left_out_text(record.kinds); !left_out.empty())
    text += "not in the estimate: " + left_out + "\n";
  text += fmt::format("\n{} runs, {}; the settings of these results\n", record.trials.size(), [&] {
    double sum = 0;
    for (const TargetRecord::Trial& trial : record.trials) sum += trial.seconds;
    return duration_text(sum);
  }());
  for (const std::string& setting : record.overrides) text += "  --set " + setting + "\n";
  return text;
}

std::string summary_with_target(const std::string& summary, const TargetRecord& record) {
  Json json = Json::parse(summary);
  Json told = {{"target", record.wanted.text},
               {"of", record.result.column},
               {"quantity", name_of(record.result.quantity)},
               {"value", number(record.value)},
               {"estimated_error", number(record.bar)}};
  if (record.wanted.is_share) {
    told["relative_error"] = number(record.bar / record.goal.scale);
    told["relative_to"] = record.goal.scale;
  }
  told["met"] = record.is_met;
  for (std::size_t i = 0; i < record.courses.size(); ++i) {
    const ErrorCourse& course = record.courses[i];
    const Direction& direction = record.kinds[i].coarser;
    Json part;
    if (course.points.size() > 1) {
      const DiscretisationError error = error_of(course);
      part = {{"error", number(error.bar)}, {"order", number(error.order)}};
      if (!error.doubt.empty()) part["doubt"] = error.doubt;
      for (const SizedValue& point : course.points)
        part["sizes"].push_back(point.size / course.size());
    }
    if (!direction.remark.empty()) part["remark"] = direction.remark;
    if (!direction.left_out.empty()) part["not_in_the_estimate"] = direction.left_out;
    told["parts"][course.name] = part;
  }
  told["settings"] = record.overrides;
  for (const TargetRecord::Trial& trial : record.trials) {
    Json entry = {{"name", trial.name}, {"wall_s", trial.seconds}};
    if (!trial.failure.empty()) entry["failed"] = trial.failure;
    told["runs"].push_back(entry);
  }
  json["target_error"] = told;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace articular::tools
