#pragma once

#include "fem/base/types.hpp"

namespace articular::sim {

/// Squared distance of a point from the triangle a b c [m²].
double squared_distance(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace articular::sim
