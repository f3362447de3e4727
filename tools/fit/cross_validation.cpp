#include "tools/fit/cross_validation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/base/error.hpp"
#include "tools/fit/fit_values.hpp"
#include "tools/study/csv_cell.hpp"

namespace articular::tools {
namespace {

bool is_in_group(const FitMeasurement& m) { return !m.held_out && !m.group.empty(); }

/// In the order of the file.
std::vector<std::string> groups_of(const Fit& fit) {
  std::vector<std::string> groups;
  for (const FitMeasurement& m : fit.measurements)
    if (is_in_group(m) && std::find(groups.begin(), groups.end(), m.group) == groups.end())
      groups.push_back(m.group);
  return groups;
}

Fit without(Fit fit, const std::string& group) {
  for (FitMeasurement& m : fit.measurements) m.held_out = m.held_out || m.group == group;
  return fit;
}

struct Sums {
  int measurements = 0;
  double at_start = 0, fitted = 0, left_out = 0;
};

/// Sums of squares over all groups.
Sums sums_of(const std::vector<LeftOut>& groups) {
  Sums sums;
  for (const LeftOut& g : groups) {
    sums.measurements += g.measurements;
    sums.at_start += g.measurements * g.at_start * g.at_start;
    sums.fitted += g.measurements * g.fitted * g.fitted;
    sums.left_out += g.measurements * g.left_out * g.left_out;
  }
  return sums;
}

}  // namespace

void check_groups(const Fit& fit) {
  const std::vector<std::string> groups = groups_of(fit);
  if (groups.empty())
    throw sim::InputError({fit.file.string()},
                          "--cross-validate: no [[measurement]] that is fitted has a `group`; "
                          "expected a name for those that are left out together");
  if (groups.size() == 1 &&
      std::all_of(fit.measurements.begin(), fit.measurements.end(),
                  [](const FitMeasurement& m) { return m.held_out || is_in_group(m); }))
    throw sim::InputError(
        {fit.file.string()},
        fmt::format("--cross-validate: without group `{}` nothing is left to fit", groups[0]));
}

std::vector<LeftOut> cross_validate(const Fit& fit, const FitResult& whole, int most_iterations,
                                    const StudyRunOptions& options) {
  std::vector<LeftOut> results;
  for (const std::string& group : groups_of(fit)) {
    if (!options.quiet) fmt::print(stderr, "articular: without group `{}`\n", group);
    const FitResult others =
        fit_parameters(without(fit, group), most_iterations, options, FitWidths::LeftOut);
    const auto counts = [&](const FitMeasurement& m) { return is_in_group(m) && m.group == group; };
    LeftOut& result = results.emplace_back();
    result.group = group;
    result.measurements =
        static_cast<int>(std::count_if(fit.measurements.begin(), fit.measurements.end(), counts));
    result.at_start = mean_misfit(fit, whole.before, counts);
    result.fitted = mean_misfit(fit, whole.after, counts);
    result.left_out = mean_misfit(fit, others.after, counts);
    result.converged = others.converged;
  }
  return results;
}

std::string cross_validation_text(const std::vector<LeftOut>& groups) {
  std::string text =
      "\n## Cross-validation\n\nEach group was left out, the rest fitted, and the group compared "
      "with what came out. Misfits are roots of mean squares, in spreads.\n\n"
      "| left out | measurements | at the start | fitted with the rest | left out |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (const LeftOut& g : groups)
    text += fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.2f}{} |\n", g.group, g.measurements,
                        g.at_start, g.fitted, g.left_out, g.converged ? "" : ", not converged");
  const Sums sums = sums_of(groups);
  return text + fmt::format("| sum of squares of all | {} | {:.1f} | {:.1f} | {:.1f} |\n",
                            sums.measurements, sums.at_start, sums.fitted, sums.left_out);
}

std::string cross_validation_csv(const std::vector<LeftOut>& groups) {
  std::string text = "group,measurements,start,fitted,left out,converged\n";
  for (const LeftOut& g : groups)
    text +=
        fmt::format("{},{},{},{},{},{}\n", csv_cell(g.group), g.measurements, csv_cell(g.at_start),
                    csv_cell(g.fitted), csv_cell(g.left_out), g.converged ? "yes" : "no");
  return text;
}

}  // namespace articular::tools
