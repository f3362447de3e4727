#include "tools/render/film_frames.hpp"

#include <algorithm>
#include <cmath>

namespace articular::tools {

std::vector<int> film_frames(const std::vector<double>& times, std::optional<double> speed,
                             int frames_per_second) {
  std::vector<int> shown(times.size(), speed ? 0 : 1);
  if (!speed) return shown;
  const double step = *speed / frames_per_second;  // [s] simulated
  const double slack = 1e-6 * step;                // of round-off
  const auto ticks = static_cast<long>(std::floor((times.back() - times.front() + slack) / step));
  for (long k = 0; k <= ticks; ++k) {
    const double now = times.front() + static_cast<double>(k) * step + slack;
    const auto next = std::upper_bound(times.begin(), times.end(), now);
    ++shown[static_cast<std::size_t>(next - times.begin() - 1)];
  }
  shown.back() = std::max(shown.back(), 1);  // a film ends with the end
  return shown;
}

}  // namespace articular::tools
