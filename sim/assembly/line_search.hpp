#pragma once

#include <algorithm>
#include <cmath>

namespace articular::sim {

/// Whether a search along a correction goes on: where it leads goes uphill on its other side nearly
/// as steeply as downhill at the start; or nothing can be there, as the slope is NaN.
/// @param slope  of the energy along the correction where it starts, by the part; negative:
/// downhill
inline bool is_far_uphill(double slope, double there) {
  constexpr double kMostUphill = 0.8;  // of the slope at the start
  return slope < 0 && !(there <= -kMostUphill * slope);
}

/// The part of a Newton correction to take: all of it, unless it leads far uphill again on its
/// other side, where contacts have closed; then to about the lowest point on the way. Looking costs
/// little beside the matrix of the next correction.
/// @param most      at most this part
/// @param slope     where it starts, see above; where it is not downhill there is nothing to search
/// @param there     that slope at `most`
/// @param slope_at  and at a part
template <class SlopeAt>
double searched_part(double most, double slope, double there, SlopeAt&& slope_at) {
  constexpr double kMostDownhill = 0.5;  // of the slope at the start
  constexpr int kMostTrials = 8;
  if (!is_far_uphill(slope, there)) return most;
  double low = 0, high = most, slope_low = slope, slope_high = there;
  const auto between = [&] {
    const double secant = std::isfinite(slope_high) ? slope_low / (slope_low - slope_high) : 0.25;
    return low + std::clamp(secant, 0.1, 0.5) * (high - low);
  };
  double part = between();
  for (int trial = 1; trial < kMostTrials; ++trial) {
    there = slope_at(part);
    const bool is_beyond = is_far_uphill(slope, there);
    if (!is_beyond && there >= kMostDownhill * slope) return part;
    (is_beyond ? high : low) = part;
    (is_beyond ? slope_high : slope_low) = there;
    part = between();
  }
  return low > 0 ? low : part;
}

/// The same where the slope at `most` is not known.
template <class SlopeAt>
double searched_part(double most, double slope, SlopeAt&& slope_at) {
  return slope < 0 ? searched_part(most, slope, slope_at(most), slope_at) : most;
}

}  // namespace articular::sim
