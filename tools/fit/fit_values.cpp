#include "tools/fit/fit_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/output/history_column.hpp"

namespace articular::tools {
namespace {

const std::vector<double>& column_of(const std::string& name, const RunHistory& history,
                                     const std::string& what) {
  const auto found = std::find(history.names.begin(), history.names.end(), name);
  if (found == history.names.end())
    throw sim::InputError(fmt::format("{}: history.csv has no column `{}`{}", what, name,
                                      sim::suggestion(name, history.names)));
  return history.columns[static_cast<std::size_t>(found - history.names.begin())];
}

/// Where a time lies in a run: `share` of the way from row `before` to the next one.
struct Moment {
  std::size_t before = 0;
  double share = 0;
};

Moment moment_of(double time, const std::vector<double>& times, const std::string& what) {
  // A time that is written in decimals may differ in its last bit from the sum of the steps.
  const double slack = 1e-9 * (std::abs(times.back()) + std::abs(time));
  if (time < times.front() - slack || time > times.back() + slack)
    throw sim::InputError(
        fmt::format("{}: expected a time from {:g} to {:g} s, which the run has, "
                    "found {:g} s",
                    what, times.front(), times.back(), time));
  const auto after = std::lower_bound(times.begin() + 1, times.end() - 1, time - slack);
  const auto i = static_cast<std::size_t>(after - times.begin());
  const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return {i - 1, std::clamp(share, 0.0, 1.0)};
}

constexpr double kOnARow = 1e-6;  // of the way to the next one

bool is_on_a_row(const Moment& moment) {
  return moment.share < kOnARow || moment.share > 1 - kOnARow;
}

void refuse_between_rows(double time, const std::vector<double>& times, const Moment& moment,
                         const std::string& what) {
  if (is_on_a_row(moment)) return;
  throw sim::InputError(fmt::format(
      "{}: the static run has no equilibrium at {:g} s; the nearest are at {:g} and {:g} s. Choose "
      "one of them, or an `integrator.step` of which {:g} s is a multiple",
      what, time, times[moment.before], times[moment.before + 1], time));
}

double value_at(const std::vector<double>& values, const Moment& moment) {
  if (is_on_a_row(moment))  // its neighbour may be empty
    return values[moment.share < kOnARow ? moment.before : moment.before + 1];
  return (1 - moment.share) * values[moment.before] + moment.share * values[moment.before + 1];
}

double sum_at(const FitMeasurement& measurement, double time, const RunHistory& history,
              sim::Scenario::Analysis analysis, const std::string& what) {
  const std::vector<double>& times = history.columns[0];
  const Moment moment = moment_of(time, times, what);
  if (analysis == sim::Scenario::Analysis::Static) refuse_between_rows(time, times, moment, what);
  double sum = 0;
  for (const std::string& name : measurement.columns) {
    if (sim::history_column(name).unit != sim::history_column(measurement.columns.front()).unit)
      throw sim::InputError(fmt::format("{}: columns `{}` and `{}` have different units", what,
                                        measurement.columns.front(), name));
    const std::vector<double>& values = column_of(name, history, what);
    const double value = value_at(values, moment);
    if (!std::isfinite(value))
      throw sim::InputError(fmt::format("{}: column `{}` is empty at {:g} s", what, name, time));
    sum += value;
  }
  return sum;
}

}  // namespace

double measured_value(const FitMeasurement& measurement, const RunHistory& history,
                      sim::Scenario::Analysis analysis, const std::string& fit_file) {
  const std::string what = fmt::format("{}: measurement `{}`", fit_file, measurement.name);
  if (history.columns[0].size() < 2)
    throw sim::InputError(fmt::format("{}: history.csv has one row alone", what));
  const double value = sum_at(measurement, measurement.at, history, analysis, what);
  if (!measurement.minus) return value;
  return value - sum_at(measurement, *measurement.minus, history, analysis, what);
}

double difference_in_spreads(const FitMeasurement& measurement, double value) {
  return (value - measurement.value) / measurement.spread;
}

double misfit(const FitMeasurement& measurement, double value) {
  const double difference = difference_in_spreads(measurement, value);
  if (measurement.target == FitTarget::AtMost) return std::max(0.0, difference);
  if (measurement.target == FitTarget::AtLeast) return std::min(0.0, difference);
  return difference;
}

double mean_misfit(const Fit& fit, const Eigen::VectorXd& values,
                   const std::function<bool(const FitMeasurement&)>& counts) {
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < fit.measurements.size(); ++k) {
    if (!counts(fit.measurements[k])) continue;
    const double off = misfit(fit.measurements[k], values[static_cast<Eigen::Index>(k)]);
    sum += off * off;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

}  // namespace articular::tools
