#include "tools/study/study_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "tools/study/observed_order.hpp"

namespace articular::tools {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  return cells;
}

/// Linear between the times, constant before and after.
double value_at(const OutputValue& curve, double time) {
  const auto after = std::lower_bound(curve.times.begin(), curve.times.end(), time);
  const auto i = static_cast<std::size_t>(after - curve.times.begin());
  if (i == 0) return curve.values.front();
  if (i == curve.times.size()) return curve.values.back();
  const double t0 = curve.times[i - 1], t1 = curve.times[i];
  const double share = (time - t0) / (t1 - t0);
  return (1 - share) * curve.values[i - 1] + share * curve.values[i];
}

/// Whether the step from coarse to medium goes the way of that from medium to fine, on the whole.
bool same_direction(const OutputValue& fine, const OutputValue& medium, const OutputValue& coarse) {
  double product = 0;
  for (std::size_t i = 0; i < coarse.values.size(); ++i) {
    const double m = value_at(medium, coarse.times[i]);
    product += (m - value_at(fine, coarse.times[i])) * (coarse.values[i] - m);
  }
  return product > 0;
}

/// Differences are taken at the times of the coarser run, which the finer one has too if its step
/// is a part of the coarser one's.
ReferenceValue extrapolated(std::span<const OutputValue> runs, std::span<const double> sizes) {
  const OutputValue &fine = runs[0], &medium = runs[1], &coarse = runs[2];
  const double e21 = difference(medium, fine), e32 = difference(coarse, medium);
  const double r21 = sizes[1] / sizes[0], r32 = sizes[2] / sizes[1];
  const double order = observed_order(e21, e32, r21, r32);
  const bool converging = e21 == 0 || same_direction(fine, medium, coarse);
  ReferenceValue reference{fine};
  if (!converging || order <= kLeastOrder) {
    reference.uncertainty = std::max(e21, e32);
    return reference;
  }
  const double share = 1 / (std::pow(r21, order) - 1);
  reference.value = medium;
  for (std::size_t i = 0; i < medium.values.size(); ++i) {
    const double nearest = value_at(fine, medium.times[i]);
    reference.value.values[i] = nearest + share * (nearest - medium.values[i]);
  }
  reference.order = order;
  reference.uncertainty = kGridSafety * share * e21;
  return reference;
}

/// Over the time, by the trapezium rule.
double mean(const OutputValue& curve) {
  const std::size_t n = curve.values.size();
  const double duration = curve.times[n - 1] - curve.times[0];
  if (!(duration > 0)) return curve.values[n - 1];
  double sum = 0;
  for (std::size_t i = 1; i < n; ++i)
    sum += 0.5 * (curve.values[i - 1] + curve.values[i]) * (curve.times[i] - curve.times[i - 1]);
  return sum / duration;
}

}  // namespace

RunHistory read_history(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) throw sim::SystemError(file.string() + ": can't be read");
  RunHistory history;
  history.names = cells_of(line);
  history.columns.resize(history.names.size());
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = cells_of(line);
    for (std::size_t i = 0; i < history.columns.size(); ++i)
      history.columns[i].push_back(i < cells.size() && !cells[i].empty()
                                       ? std::strtod(cells[i].c_str(), nullptr)
                                       : kNoValue);
  }
  if (history.columns[0].empty())
    throw sim::SystemError(file.string() + ": holds no row of results");
  return history;
}

OutputValue output_value(const StudyOutput& output, const RunHistory& history,
                         const std::string& study_file) {
  const auto name = std::find(history.names.begin(), history.names.end(), output.column);
  if (name == history.names.end())
    throw sim::InputError(
        {study_file}, fmt::format("output `{}`: history.csv has no column `{}`{}", output.name,
                                  output.column, sim::suggestion(output.column, history.names)));
  const std::vector<double>& times = history.columns[0];
  const std::vector<double>& all =
      history.columns[static_cast<std::size_t>(name - history.names.begin())];
  OutputValue result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!std::isfinite(all[i])) continue;  // an empty cell: there was nothing to say
    result.times.push_back(times[i]);
    result.values.push_back(all[i]);
  }
  if (output.value == StudyValue::History && !result.values.empty()) return result;
  if (result.values.empty()) return {{times.back()}, {kNoValue}};
  const auto [least, most] = std::minmax_element(result.values.begin(), result.values.end());
  double value = result.values.back();
  if (output.value == StudyValue::Change) value -= result.values.front();
  if (output.value == StudyValue::Largest) value = *most;
  if (output.value == StudyValue::Smallest) value = *least;
  if (output.value == StudyValue::Mean) value = mean(result);
  return {{times.back()}, {value}};
}

double difference(const OutputValue& a, const OutputValue& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double d = std::abs(a.values[i] - value_at(b, a.times[i]));
    if (!std::isfinite(d)) return d;
    most = std::max(most, d);
  }
  return most;
}

ReferenceValue reference_value(std::span<const OutputValue> runs, std::span<const double> sizes) {
  if (runs.size() == 3) return extrapolated(runs, sizes);
  ReferenceValue reference{runs[0]};
  reference.uncertainty =
      runs.size() == 1 ? kNoValue : difference(runs[1], runs[0]) / (sizes[1] / sizes[0] - 1);
  return reference;
}

}  // namespace articular::tools
