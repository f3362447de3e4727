#include "tools/track/track_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/output/history_column.hpp"
#include "sim/scenario/curve.hpp"
#include "tools/fit/missed_target.hpp"
#include "tools/study/csv_cell.hpp"

namespace articular::tools {
namespace {

using Eigen::Index;

constexpr std::array<const char*, 3> kCostWords{"squares", "cubes", "largest"};
/// Of the variance that the bounds alone leave.
constexpr double kDetermined = 0.9, kNotDetermined = 0.1;
/// Beyond, slopes are too wrong to go by.
constexpr double kInexact = 1e-2;

std::string unit_of(const TrackTarget& target) {
  return sim::history_column(target.columns.front()).unit;
}

std::string words_for_share(double share) {
  if (share >= kDetermined) return "determined";
  return share <= kNotDetermined ? "not determined" : "in part";
}

bool is_at(double bound, double value) { return std::abs(value - bound) < 1e-6; }

std::string target_table(const Track& track, const TrackResult& result) {
  std::string text =
      "| target | spread | largest misfit | at | mean misfit |\n| --- | --- | --- | --- | --- |\n";
  for (std::size_t k = 0; k < track.targets.size(); ++k) {
    const TrackTarget& target = track.targets[k];
    const auto i = static_cast<Index>(k);
    double largest = 0, when = 0, sum = 0;
    int count = 0;
    for (const TrackPoint& point : result.points) {
      if (!std::isfinite(point.wanted[i])) continue;
      const double off = point.got[i] - point.wanted[i];
      sum += off * off;
      if (count++ == 0 || std::abs(off) > std::abs(largest)) {
        largest = off;
        when = point.time;
      }
    }
    if (count == 0) {
      text += fmt::format("| {} | {} {} | counts at no time | | |\n", target.name, target.spread,
                          unit_of(target));
      continue;
    }
    text += fmt::format("| {0} | {1} {5} | {2:.3g} {5} | {3:g} s | {4:.3g} {5} |\n", target.name,
                        target.spread, largest, when, std::sqrt(sum / count), unit_of(target));
  }
  return text;
}

std::string muscle_table(const TrackResult& result) {
  std::string text =
      "| muscle | largest excitation | at | of what its bounds leave open, the targets settle | "
      "|\n| --- | --- | --- | --- | --- |\n";
  for (std::size_t u = 0; u < result.unknowns.size(); ++u) {
    const auto i = static_cast<Index>(u);
    const TrackPoint* most = &result.points.front();
    double least_share = 1, greatest_share = 0;
    for (const TrackPoint& point : result.points) {
      if (point.excitation[i] > most->excitation[i]) most = &point;
      least_share = std::min(least_share, point.determination.from_data[i]);
      greatest_share = std::max(greatest_share, point.determination.from_data[i]);
    }
    const TrackMuscle& given = *result.unknowns[u].given;
    const double value = most->excitation[i];
    const char* bound = is_at(given.highest, value)  ? ", at its highest"
                        : is_at(given.lowest, value) ? ", at its lowest"
                                                     : "";
    text += fmt::format("| `{}` | {:.4f}{} | {:g} s | {:.0f} to {:.0f} % | {} |\n",
                        result.unknowns[u].name, value, bound, most->time, 100 * least_share,
                        100 * greatest_share, words_for_share(least_share));
  }
  return text;
}

std::string cost_table(const Track& track, const TrackResult& result) {
  const TrackPoint& point = *std::max_element(result.points.begin(), result.points.end(),
                                              [](const TrackPoint& a, const TrackPoint& b) {
                                                return a.excitation.sum() < b.excitation.sum();
                                              });
  std::string text = fmt::format("At {:g} s, where muscles are most active:\n\n| |", point.time);
  for (const char* word : kCostWords) text += fmt::format(" {} |", word);
  text += "\n| --- | --- | --- | --- |\n";
  for (std::size_t u = 0; u < result.unknowns.size(); ++u) {
    text += fmt::format("| `{}` |", result.unknowns[u].name);
    for (const Eigen::VectorXd& a : point.by_cost)
      text += fmt::format(" {:.4f} |", a[static_cast<Index>(u)]);
    text += "\n";
  }
  text += "| misfit, in spreads |";
  for (const double misfit : point.misfit_by_cost) text += fmt::format(" {:.3f} |", misfit);
  return text + fmt::format("\n\nFound with `{}`. The others are told by the slopes there.\n",
                            kCostWords[static_cast<std::size_t>(track.cost)]);
}

std::string time_table(const TrackResult& result) {
  std::string text =
      "| time | misfit, in spreads | runs from the time before | directions that targets determine "
      "| singular values |\n| --- | --- | --- | --- | --- |\n";
  for (const TrackPoint& point : result.points) {
    std::string values;
    for (const double value : point.determination.singular_values)
      values += fmt::format("{}{:.2g}", values.empty() ? "" : ", ", value);
    text += fmt::format("| {:g} s | {:.3f} | {}{} | {} of {} | {} |\n", point.time, point.misfit,
                        point.trials, point.converged ? "" : ", not converged",
                        point.determination.determined, point.excitation.size(), values);
  }
  return text;
}

std::string doubts(const TrackResult& result) {
  double error = 0;
  for (const TrackPoint& point : result.points) error = std::max(error, point.response_error);
  if (error < kInexact) return "";
  return fmt::format(
      "\n**Slopes are inexact**: up to {:.2g} of the forces stayed unbalanced where they were "
      "solved for. What is said of determined muscles and other costs may be wrong; the misfits "
      "are "
      "right.\n",
      error);
}

}  // namespace

std::string excitations_csv(const TrackResult& result) {
  std::string text = "time [s]";
  for (const TrackUnknown& unknown : result.unknowns)
    for (const std::string& name : unknown.muscle_names) text += "," + csv_cell(name);
  const auto row = [&](double time, const Eigen::VectorXd& excitation) {
    text += fmt::format("\n{:.12g}", time);
    for (std::size_t u = 0; u < result.unknowns.size(); ++u)
      for (std::size_t k = 0; k < result.unknowns[u].muscles.size(); ++k)
        text += fmt::format(",{}", excitation[static_cast<Index>(u)]);
  };
  row(0, result.start);
  for (const TrackPoint& point : result.points) row(point.time, point.excitation);
  return text + "\n";
}

std::string excitation_overrides(const Track& track, const std::filesystem::path& table) {
  std::string text = fmt::format("# Found by `articular track {}`.\n", track.file.string());
  for (const std::string& set : track.overrides) text += set + "\n";
  return text + fmt::format("excitations.file = \"{}\"\n", table.string());
}

std::string targets_csv(const Track& track, const TrackResult& result) {
  std::string text = "time [s],target,unit,wanted,got,spread\n";
  for (const TrackPoint& point : result.points)
    for (std::size_t k = 0; k < track.targets.size(); ++k) {
      const auto i = static_cast<Index>(k);
      text += fmt::format("{},{},{},{},{},{}\n", point.time, csv_cell(track.targets[k].name),
                          unit_of(track.targets[k]), csv_cell(point.wanted[i]),
                          csv_cell(point.got[i]), track.targets[k].spread);
    }
  return text;
}

std::string missed_targets(const Track& track, const TrackResult& result) {
  std::vector<TargetMisfit> misfits;
  /// @param off_at  in spreads; NaN where it does not count
  const auto add = [&](const std::string& name, auto off_at) {
    TargetMisfit worst;
    for (const TrackPoint& point : result.points)
      if (const double off = off_at(point); std::abs(off) > std::abs(worst.spreads))
        worst = {fmt::format("{} at {:g} s", name, point.time), off};
    misfits.push_back(std::move(worst));
  };
  for (std::size_t k = 0; k < track.targets.size(); ++k)
    add(fmt::format("`{}`", track.targets[k].name), [&](const TrackPoint& point) {
      const auto i = static_cast<Index>(k);
      return (point.got[i] - point.wanted[i]) / track.targets[k].spread;
    });
  for (std::size_t u = 0; u < result.unknowns.size(); ++u)
    if (const TrackMuscle& given = *result.unknowns[u].given; !given.emg.time.empty())
      add(fmt::format("EMG of `{}`", result.unknowns[u].name), [&](const TrackPoint& point) {
        return (point.excitation[static_cast<Index>(u)] - sim::value_at(given.emg, point.time)) /
               given.emg_spread;
      });
  return missed_text(std::move(misfits));
}

std::string muscles_csv(const TrackResult& result) {
  std::string text = "time [s],muscle,excitation,width,from_targets,squares,cubes,largest\n";
  for (const TrackPoint& point : result.points)
    for (std::size_t u = 0; u < result.unknowns.size(); ++u) {
      const auto i = static_cast<Index>(u);
      text += fmt::format("{},{},{},{},{}", point.time, csv_cell(result.unknowns[u].name),
                          csv_cell(point.excitation[i]), csv_cell(point.determination.widths[i]),
                          csv_cell(point.determination.from_data[i]));
      for (const Eigen::VectorXd& a : point.by_cost) text += "," + csv_cell(a[i]);
      text += "\n";
    }
  return text;
}

std::string track_text(const Track& track, const TrackResult& result,
                       const std::filesystem::path& overrides) {
  std::string text = fmt::format("# {}\n\n", track.title);
  if (!result.failure.empty()) text += fmt::format("**It ended early**: {}\n\n", result.failure);
  if (result.points.empty()) return text + "Nothing was found.\n";
  text += fmt::format("Until {:g} s. To run it:\n\n    articular run {} --set @{}\n",
                      result.points.back().time, track.scenario.string(), overrides.string());
  text += "\n## Targets\n\n" + target_table(track, result);
  text += missed_paragraph(missed_targets(track, result));
  text += "\n## Muscles\n\n" + muscle_table(result);
  text += "\n## Other costs\n\n" + cost_table(track, result);
  text += "\n## Times\n\n" + time_table(result);
  return text + doubts(result);
}

}  // namespace articular::tools
