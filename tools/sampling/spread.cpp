#include "tools/sampling/spread.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace articular::tools {
namespace {

/// From 1; equal values share the mean of their ranks.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i)
      ranks[order[i]] = 0.5 * static_cast<double>(begin + end + 1);
    begin = end;
  }
  return ranks;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

}  // namespace

std::vector<double> known(const std::vector<double>& values) {
  std::vector<double> result;
  for (const double value : values)
    if (std::isfinite(value)) result.push_back(value);
  return result;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sd_of(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double quantile_of(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double place = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

Histogram histogram_of(const std::vector<double>& values) {
  constexpr double kFewest = 5, kMost = 40;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double range = *most - *least;
  Histogram histogram;
  if (!(range > 0)) return {*least - 0.5, 1, {static_cast<int>(values.size())}};
  const double wanted = 2 * (quantile_of(values, 0.75) - quantile_of(values, 0.25)) /
                        std::cbrt(static_cast<double>(values.size()));
  const double bins = wanted > 0 ? std::clamp(std::ceil(range / wanted), kFewest, kMost) : kFewest;
  histogram.lowest = *least;
  histogram.width = range / bins;
  histogram.counts.assign(static_cast<std::size_t>(bins), 0);
  for (const double value : values)
    ++histogram
          .counts[static_cast<std::size_t>(std::min((value - *least) / histogram.width, bins - 1))];
  return histogram;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> known_a, known_b;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isfinite(a[i]) && std::isfinite(b[i])) {
      known_a.push_back(a[i]);
      known_b.push_back(b[i]);
    }
  if (known_a.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  return correlation(ranks_of(known_a), ranks_of(known_b));
}

}  // namespace articular::tools
