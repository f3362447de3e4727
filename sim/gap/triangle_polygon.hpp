#pragma once

#include <array>

#include "fem/base/types.hpp"

namespace articular::sim {

/// A convex polygon within a triangle, its corners in barycentric coordinates. A triangle has at
/// most one corner more for each cut; where round-off makes the levels of corners on a cut change
/// sign more often than twice, each cut adds half as many: 3, 4, 6, 9, 13, 19, 28, 42.
struct TrianglePolygon {
  static constexpr std::size_t kMaxCuts = 7, kMaxCorners = 42;
  std::array<Vec3, kMaxCorners> corner;
  /// The cut along which the edge to the next corner lies; −1 − i: the own side N_i = 0.
  std::array<int, kMaxCorners> side;
  int count = 0;
};

TrianglePolygon whole_triangle();

/// The part of a polygon where the affine function with the values `at_nodes` at the triangle's
/// nodes is >= 0: in `room`, or, where that is all of it, the polygon itself.
const TrianglePolygon& clipped(const Vec3& at_nodes, int side, const TrianglePolygon& polygon,
                               TrianglePolygon& room);

/// ∫ N Nᵀ over the polygon in units of the triangle's area. @return the polygon's area
double integrate(const TrianglePolygon& polygon, Mat3& Q);
/// ∫ ω N Nᵀ over it, for ω affine.
Mat3 weighted_integral(const TrianglePolygon& polygon, const Vec3& weight_at_nodes);

}  // namespace articular::sim
