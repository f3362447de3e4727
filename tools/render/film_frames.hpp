#pragma once

#include <optional>
#include <vector>

namespace articular::tools {

/// How often each frame is shown in a film, one after the other.
/// @param times  of the frames, ascending [s]
/// @param speed  simulated time by time in the film, > 0: at each moment the film shows the last
///               frame that has been reached; none: every frame once
std::vector<int> film_frames(const std::vector<double>& times, std::optional<double> speed,
                             int frames_per_second);

}  // namespace articular::tools
