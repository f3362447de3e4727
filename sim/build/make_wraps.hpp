#pragma once

#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// The surface of a rigid or fixed body, made the first time that a line wraps around it.
/// @return its index into Model::wrap_bodies
int wrap_body(int body, Model& model);

/// Lets a line wrap around bodies: finds its path at the start, with its length there.
/// @param points  where the points of its path are at the start [m]
/// @throws InputError where a point lies deep in one of the bodies, or no path is found
void make_wrap(const std::vector<std::string>& names, const std::vector<int>& bodies,
               const std::vector<Vec3>& points, const Location& where, Model& model, Line& line);

}  // namespace articular::sim
