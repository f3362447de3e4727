#include "sim/mesh/triangle_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace articular::sim {

// By the part of the plane that the point projects to [Ericson 2005, Real-Time Collision Detection,
// 5.1.5].
double squared_distance(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto from_edge = [&](const Vec3& p, const Vec3& q) {
    const Vec3 edge = q - p;
    const double length = edge.squaredNorm();
    const double s = length > 0 ? std::clamp((x - p).dot(edge) / length, 0.0, 1.0) : 0.0;
    return (x - p - s * edge).squaredNorm();
  };
  const Vec3 n = (b - a).cross(c - a);
  const bool inside = n.squaredNorm() > 0 && (b - a).cross(x - a).dot(n) >= 0 &&
                      (c - b).cross(x - b).dot(n) >= 0 && (a - c).cross(x - c).dot(n) >= 0;
  if (inside) return std::pow((x - a).dot(n), 2) / n.squaredNorm();
  return std::min({from_edge(a, b), from_edge(b, c), from_edge(c, a)});
}

}  // namespace articular::sim
