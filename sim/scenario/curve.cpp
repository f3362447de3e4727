#include "sim/scenario/curve.hpp"

#include <algorithm>

namespace articular::sim {

namespace {

/// The time of the curve that follows t, which lies from its first to before its last.
std::size_t next_time(const Curve& curve, double t) {
  const auto next = std::upper_bound(curve.time.begin(), curve.time.end(), t);
  return static_cast<std::size_t>(next - curve.time.begin());
}

}  // namespace

double value_at(const Curve& curve, double t) {
  if (curve.time.empty()) return 1;
  if (t <= curve.time.front()) return curve.value.front();
  if (t >= curve.time.back()) return curve.value.back();
  const std::size_t i = next_time(curve, t);
  const double s = (t - curve.time[i - 1]) / (curve.time[i] - curve.time[i - 1]);
  return curve.value[i - 1] + s * (curve.value[i] - curve.value[i - 1]);
}

double slope_at(const Curve& curve, double t) {
  if (curve.time.empty() || t < curve.time.front() || t >= curve.time.back()) return 0;
  const std::size_t i = next_time(curve, t);
  return (curve.value[i] - curve.value[i - 1]) / (curve.time[i] - curve.time[i - 1]);
}

bool changes_after(const Curve& curve, double t) {
  const double then = value_at(curve, t);
  for (std::size_t i = 0; i < curve.time.size(); ++i)
    if (curve.time[i] > t && curve.value[i] != then) return true;
  return false;
}

}  // namespace articular::sim
