#pragma once

#include <array>

#include "fem/base/types.hpp"

namespace articular::tools {

/// The rigid motion that brings points nearest to where they are now (least squares): a bone's
/// pose, from the places of its nodes.
/// @param before, now  3 x N, N > 0, one column a point
/// @return rotation, row by row, each row followed by its part of the translation
std::array<double, 12> rigid_pose(const Positions& before, const Positions& now);

}  // namespace articular::tools
