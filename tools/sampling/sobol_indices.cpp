#include "tools/sampling/sobol_indices.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace articular::tools {
namespace {

constexpr int kBootstraps = 1000;
constexpr double kTail = 0.025;

using Rows = std::vector<Eigen::Index>;

struct Plain {
  Eigen::VectorXd first, total;
};

Plain indices_of(const Eigen::MatrixXd& values, const Rows& rows) {
  const Eigen::Index num_parameters = values.cols() - 2;
  const auto n = static_cast<double>(rows.size());
  double mean = 0, square = 0;
  for (const Eigen::Index r : rows) mean += (values(r, 0) + values(r, 1)) / (2 * n);
  Plain sums{Eigen::VectorXd::Zero(num_parameters), Eigen::VectorXd::Zero(num_parameters)};
  for (const Eigen::Index r : rows) {
    const double a = values(r, 0) - mean, b = values(r, 1) - mean;
    square += (a * a + b * b) / (2 * n);
    for (Eigen::Index i = 0; i < num_parameters; ++i) {
      const double ab = values(r, 2 + i) - mean;
      sums.first[i] += b * (ab - a) / n;
      sums.total[i] += (a - ab) * (a - ab) / (2 * n);
    }
  }
  return {sums.first / square, sums.total / square};
}

Rows whole_rows(const Eigen::MatrixXd& values) {
  Rows rows;
  for (Eigen::Index r = 0; r < values.rows(); ++r)
    if (values.row(r).allFinite()) rows.push_back(r);
  return rows;
}

/// Exactly: of what does not vary, round-off would be shared out.
bool varies(const Eigen::MatrixXd& values, const Rows& rows) {
  return std::any_of(rows.begin(), rows.end(), [&](Eigen::Index r) {
    return values(r, 0) != values(rows[0], 0) || values(r, 1) != values(rows[0], 0);
  });
}

/// Between the percentiles; a bootstrap in which nothing varies says nothing.
void set_interval(std::vector<double>& samples, Estimate& estimate) {
  samples.erase(
      std::remove_if(samples.begin(), samples.end(), [](double s) { return !std::isfinite(s); }),
      samples.end());
  std::sort(samples.begin(), samples.end());
  if (samples.empty()) return;
  const auto last = static_cast<double>(samples.size() - 1);
  estimate.low = samples[static_cast<std::size_t>(kTail * last)];
  estimate.high = samples[static_cast<std::size_t>(std::ceil((1 - kTail) * last))];
}

}  // namespace

std::vector<SobolIndex> sobol_indices(const Eigen::MatrixXd& values, std::uint64_t seed) {
  const Rows rows = whole_rows(values);
  if (rows.size() < 2 || !varies(values, rows)) return {};
  const Plain plain = indices_of(values, rows);
  const auto count = static_cast<std::size_t>(plain.first.size());
  std::vector<std::vector<double>> firsts(count), totals(count);
  std::mt19937_64 generator(seed);
  Rows drawn(rows.size());
  for (int k = 0; k < kBootstraps; ++k) {
    for (Eigen::Index& r : drawn) r = rows[generator() % rows.size()];
    const Plain again = indices_of(values, drawn);
    for (std::size_t i = 0; i < count; ++i) {
      firsts[i].push_back(again.first[static_cast<Eigen::Index>(i)]);
      totals[i].push_back(again.total[static_cast<Eigen::Index>(i)]);
    }
  }
  std::vector<SobolIndex> indices(count);
  for (std::size_t i = 0; i < count; ++i) {
    indices[i].first.value = plain.first[static_cast<Eigen::Index>(i)];
    indices[i].total.value = plain.total[static_cast<Eigen::Index>(i)];
    set_interval(firsts[i], indices[i].first);
    set_interval(totals[i], indices[i].total);
  }
  return indices;
}

}  // namespace articular::tools
