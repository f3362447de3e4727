#pragma once

#include <numbers>

namespace articular::sim {

/// 360 degrees, with room for round-off [rad]. Who turns farther has mostly meant radians.
inline constexpr double kWholeTurn = 2 * std::numbers::pi * (1 + 1e-9);

}  // namespace articular::sim
