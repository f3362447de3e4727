#include "sim/scenario/curve.hpp"

#include <algorithm>

namespace articular::sim {

double value_at(const Curve& curve, double t) {
  if (curve.time.empty()) return 1;
  if (t <= curve.time.front()) return curve.value.front();
  if (t >= curve.time.back()) return curve.value.back();
  const auto next = std::upper_bound(curve.time.begin(), curve.time.end(), t);
  const auto i = static_cast<std::size_t>(next - curve.time.begin());
  const double s = (t - curve.time[i - 1]) / (curve.time[i] - curve.time[i - 1]);
  return curve.value[i - 1] + s * (curve.value[i] - curve.value[i - 1]);
}

}  // namespace articular::sim
