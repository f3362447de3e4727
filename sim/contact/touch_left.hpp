#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace articular::sim {

/// The part that is left of the force on a body by others; 1 where nothing touched it.
/// @param before, now  ContactResponse::force_on_bodies(); empty before anything could touch
inline double touch_left(const std::vector<double>& before, const std::vector<double>& now,
                         std::size_t body) {
  return body < before.size() && before[body] > 0 ? now[body] / before[body] : 1;
}

/// The least one of all bodies.
inline double least_touch_left(const std::vector<double>& before, const std::vector<double>& now) {
  double least = 1;
  for (std::size_t body = 0; body < before.size(); ++body)
    least = std::min(least, touch_left(before, now, body));
  return least;
}

}  // namespace articular::sim
