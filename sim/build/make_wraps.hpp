#pragma once

#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Lets a line wrap around bodies: finds its path at the start, with its length there.
/// @param points  where the points of its path are at the start [m]
/// @throws InputError where a point lies deep in one of the bodies, or no path is found
void make_wrap(const std::vector<std::string>& names, const std::vector<int>& bodies,
               const std::vector<Vec3>& points, const Location& where, Model& model, Line& line);

}  // namespace articular::sim
