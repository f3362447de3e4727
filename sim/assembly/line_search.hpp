#pragma once

#include <algorithm>
#include <cmath>

namespace articular::sim {

/// The part of a Newton correction to take: all of it, unless it leads far uphill again on its
/// other side, where contacts have closed; then to about the lowest point on the way. Looking costs
/// little beside the matrix of the next correction.
/// @param most      at most this part
/// @param slope     of the energy along the correction where it starts, by the part; negative:
///                  downhill, else there is nothing to search for
/// @param slope_at  that slope at a part; NaN: nothing can be there
template <class SlopeAt>
double searched_part(double most, double slope, SlopeAt&& slope_at) {
  constexpr double kMostUphill = 0.8, kMostDownhill = 0.5;  // of the slope at the start
  constexpr int kMostTrials = 8;
  if (!(slope < 0)) return most;
  double low = 0, high = most, slope_low = slope, slope_high = slope;
  double part = most;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    const double there = slope_at(part);
    const bool is_beyond = !(there <= -kMostUphill * slope);  // NaN too
    if (!is_beyond && (part == most || there >= kMostDownhill * slope)) return part;
    (is_beyond ? high : low) = part;
    (is_beyond ? slope_high : slope_low) = there;
    const double secant = std::isfinite(slope_high) ? slope_low / (slope_low - slope_high) : 0.25;
    part = low + std::clamp(secant, 0.1, 0.5) * (high - low);
  }
  return low > 0 ? low : part;
}

}  // namespace articular::sim
