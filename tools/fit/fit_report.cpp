#include "tools/fit/fit_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/output/history_column.hpp"
#include "tools/fit/fit_values.hpp"
#include "tools/fit/missed_target.hpp"
#include "tools/fit/parameter_text.hpp"
#include "tools/study/braces.hpp"
#include "tools/study/csv_cell.hpp"

namespace articular::tools {
namespace {

using Eigen::Index;

constexpr double kToldCorrelation = 0.9;

bool is_held_out(const FitMeasurement& m) { return m.held_out; }
bool is_fitted(const FitMeasurement& m) { return !m.held_out; }

std::string with_unit(double value, const std::string& unit) {
  return unit.empty() || unit == "-" ? fmt::format("{:.4g}", value)
                                     : fmt::format("{:.4g} {}", value, unit);
}

std::string target_text(const FitMeasurement& m) {
  const std::string unit = sim::history_column(m.columns.front()).unit;
  if (m.target == FitTarget::AtMost) return "at most " + with_unit(m.value, unit);
  if (m.target == FitTarget::AtLeast) return "at least " + with_unit(m.value, unit);
  return fmt::format("{:.4g} ± {}", m.value, with_unit(m.spread, unit));
}

std::string measurement_table(const Fit& fit, const FitResult& result, bool held_out) {
  std::string text =
      "| | measured | at the start | fitted | off by, in spreads |\n| --- | --- | --- | --- | --- "
      "|\n";
  for (std::size_t k = 0; k < fit.measurements.size(); ++k) {
    const FitMeasurement& m = fit.measurements[k];
    if (m.held_out != held_out) continue;
    const auto i = static_cast<Index>(k);
    text += fmt::format("| {} | {} | {:.4g} | {:.4g} | {:.2f} |\n", m.name, target_text(m),
                        result.before[i], result.after[i], misfit(m, result.after[i]));
  }
  return text;
}

std::string bound_text(const FitParameter& p, double value) {
  const double near = 1e-3 * (p.spread ? *p.spread : p.step);
  if (value < p.lowest + near) return ", at its lowest";
  if (value > p.highest - near) return ", at its highest";
  return "";
}

std::string parameter_table(const Fit& fit, const FitResult& result) {
  std::string text =
      "| parameter | known before | fitted | of the variance, the measurements take away |\n"
      "| --- | --- | --- | --- |\n";
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const FitParameter& p = fit.parameters[k];
    const auto i = static_cast<Index>(k);
    const double value = result.parameters[i], width = result.determination.widths[i];
    const std::string before = p.spread ? fmt::format("{:.4g} ± {}", p.known.value_or(p.start),
                                                      with_unit(*p.spread, p.unit))
                                        : with_unit(p.start, p.unit) + " to begin with";
    const std::string after = std::isfinite(width)
                                  ? fmt::format("{:.4g} ± {}", value, with_unit(width, p.unit))
                                  : with_unit(value, p.unit) + ", not determined";
    text += fmt::format("| `{}` | {} | {}{} | {:.0f} % |\n", p.name, before, after,
                        bound_text(p, value), 100 * result.determination.from_data[i]);
  }
  return text;
}

std::string correlations(const Fit& fit, const FitResult& result) {
  std::string text;
  const Eigen::MatrixXd& c = result.determination.correlation;
  for (Index i = 0; i < c.rows(); ++i)
    for (Index j = 0; j < i; ++j)
      if (std::abs(c(i, j)) > kToldCorrelation)
        text += fmt::format("- `{}` and `{}` can hardly be told apart (correlation {:.2f}).\n",
                            fit.parameters[static_cast<std::size_t>(j)].name,
                            fit.parameters[static_cast<std::size_t>(i)].name, c(i, j));
  return text;
}

bool all_runs_have(const Fit& fit, const std::string& setting) {
  return std::all_of(fit.runs.begin(), fit.runs.end(), [&](const FitRun& run) {
    const std::vector<std::string>& all = run.settings.overrides;
    return std::find(all.begin(), all.end(), setting) != all.end();
  });
}

std::string ending(const FitResult& result) {
  return result.converged ? fmt::format("Converged in {} iterations.", result.iterations)
                          : fmt::format("**Not converged** after {} iterations: {}",
                                        result.iterations, result.message);
}

}  // namespace

std::string missed_measurements(const Fit& fit, const FitResult& result) {
  std::vector<TargetMisfit> misfits;
  for (std::size_t k = 0; k < fit.measurements.size(); ++k) {
    const FitMeasurement& m = fit.measurements[k];
    if (!m.held_out)
      misfits.push_back(
          {fmt::format("`{}`", m.name), misfit(m, result.after[static_cast<Index>(k)])});
  }
  return missed_text(std::move(misfits));
}

std::string fit_text(const Fit& fit, const FitResult& result) {
  const Determination& d = result.determination;
  std::string text = fmt::format("# {}\n\n{}\n\n## Measurements\n\n", fit.title, ending(result));
  text += measurement_table(fit, result, false);
  text += fmt::format("\nMean misfit: {:.2f} spreads, {:.2f} at the start.\n",
                      mean_misfit(fit, result.after, is_fitted),
                      mean_misfit(fit, result.before, is_fitted));
  text += missed_paragraph(missed_measurements(fit, result));
  const bool any_held_out = mean_misfit(fit, result.after, is_held_out) > 0;
  if (any_held_out) {
    text += "\n## Held out\n\nNot fitted; they say what the fit is worth elsewhere.\n\n" +
            measurement_table(fit, result, true);
    text += fmt::format("\nMean misfit: {:.2f} spreads, {:.2f} at the start.\n",
                        mean_misfit(fit, result.after, is_held_out),
                        mean_misfit(fit, result.before, is_held_out));
  }
  text += "\n## Parameters\n\n" + parameter_table(fit, result);
  text += fmt::format(
      "\nOf {} directions in the space of the parameters the measurements determine {}.\n",
      fit.parameters.size(), d.determined);
  if (d.scale > 1)
    text += fmt::format("Misfits are larger than the spreads, so widths are {:.2f} times wider.\n",
                        d.scale);
  return text + correlations(fit, result);
}

std::string measurements_csv(const Fit& fit, const FitResult& result) {
  std::string text = "measurement,unit,target,measured,spread,held out,start,fitted,misfit\n";
  for (std::size_t k = 0; k < fit.measurements.size(); ++k) {
    const FitMeasurement& m = fit.measurements[k];
    const auto i = static_cast<Index>(k);
    const char* const target = m.target == FitTarget::Value    ? "value"
                               : m.target == FitTarget::AtMost ? "at most"
                                                               : "at least";
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(m.name),
                        csv_cell(sim::history_column(m.columns.front()).unit), target,
                        csv_cell(m.value), csv_cell(m.spread), m.held_out ? "yes" : "no",
                        csv_cell(result.before[i]), csv_cell(result.after[i]),
                        csv_cell(misfit(m, result.after[i])));
  }
  return text;
}

std::string parameters_csv(const Fit& fit, const FitResult& result) {
  std::string text =
      "parameter,unit,start,known,spread,lowest,highest,fitted,width,from measurements\n";
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const FitParameter& p = fit.parameters[k];
    const auto i = static_cast<Index>(k);
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{}\n", p.name, csv_cell(p.unit), csv_cell(p.start),
        p.spread ? csv_cell(p.known.value_or(p.start)) : "", p.spread ? csv_cell(*p.spread) : "",
        csv_cell(p.lowest), csv_cell(p.highest), csv_cell(result.parameters[i]),
        csv_cell(result.determination.widths[i]), csv_cell(result.determination.from_data[i]));
  }
  return text;
}

std::string fitted_overrides(const Fit& fit, const FitResult& result) {
  const std::vector<std::string> first = overrides_of(fit, fit.runs.front(), result.parameters);
  const std::vector<std::string>& written = fit.runs.front().settings.overrides;
  std::string text;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool has_parameter = i >= written.size() || !names_in_braces(written[i]).empty();
    if (has_parameter || all_runs_have(fit, first[i])) text += first[i] + "\n";
  }
  return text;
}

}  // namespace articular::tools
