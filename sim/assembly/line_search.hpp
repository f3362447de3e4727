#pragma once

#include <algorithm>
#include <cmath>

namespace articular::sim {

/// The part of a Newton correction to take: as much of it as does not lead far uphill again on its
/// other side, where contacts have closed.
/// @param most      at most this part
/// @param slope     of the energy along the correction where it starts, by the part; negative:
///                  downhill, else there is nothing to search for
/// @param slope_at  that slope at a part; NaN: nothing can be there
template <class SlopeAt>
double searched_part(double most, double slope, SlopeAt&& slope_at) {
  constexpr double kSlopeFall = 0.8;
  constexpr int kMostTrials = 8;
  double part = most;
  if (!(slope < 0)) return part;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    const double there = slope_at(part);
    if (there <= -kSlopeFall * slope) return part;  // false for NaN
    const double secant = std::isfinite(there) ? slope / (slope - there) : 0.25;
    part *= std::clamp(secant, 0.1, 0.5);
  }
  return part;
}

}  // namespace articular::sim
