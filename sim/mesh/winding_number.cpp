#include "sim/mesh/winding_number.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace articular::sim {

bool is_closed(const Triangles& triangles) {
  std::set<std::pair<int, int>> open;
  for (const auto& t : triangles.colwise())
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (open.erase({b, a}) == 0 && !open.insert({a, b}).second) return false;
    }
  return open.empty() && triangles.cols() > 0;
}

double winding_number(const Positions& X, const Triangles& triangles, const Vec3& x) {
  double angle = 0;
  for (const auto& triangle : triangles.colwise()) {
    const Vec3 a = X.col(triangle[0]) - x, b = X.col(triangle[1]) - x, c = X.col(triangle[2]) - x;
    const double na = a.norm(), nb = b.norm(), nc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)),
                            na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb);
  }
  return angle / (4 * std::numbers::pi);
}

}  // namespace articular::sim
