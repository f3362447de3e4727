#pragma once

#include "fem/base/types.hpp"

namespace articular::sim {

/// In the plane z = 0 around the origin, looking up.
inline Mat3 large_face() {
  Mat3 f;
  f << -20, 20, 0, -20, -20, 30, 0, 0, 0;
  return f;
}

/// Looks down, by `depth` behind that face.
inline Mat3 small_triangle(double depth) {
  Mat3 s;
  s << 0, 0, 1, 0, 1, 0, -depth, -depth, -depth;
  return s;
}

}  // namespace articular::sim
