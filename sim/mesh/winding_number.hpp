#pragma once

#include "fem/base/types.hpp"

namespace articular::sim {

/// Whether each edge is passed once each way, and there is a triangle.
bool is_closed(const Triangles& triangles);

/// How often a closed surface goes round x: about 1 inside, 0 outside [Van Oosterom and Strackee
/// 1983, IEEE Trans. Biomed. Eng. 30, for the solid angle of a triangle].
double winding_number(const Positions& X, const Triangles& triangles, const Vec3& x);

}  // namespace articular::sim
