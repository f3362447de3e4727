#include "sim/mesh/chord_depth.hpp"

#include <vector>

#include "sim/mesh/winding_number.hpp"

namespace articular::sim {
namespace {

constexpr int kIntervals = 100;  // of the line

bool is_inside(const Positions& X, const Triangles& triangles, const Vec3& x) {
  return winding_number(X, triangles, x) > 0.5;
}

}  // namespace

double depth_inside(const Positions& X, const Triangles& triangles, const TriangleTree& tree,
                    const Vec3& x) {
  return is_inside(X, triangles, x) ? tree.distance(x) : 0;
}

double chord_depth(const Positions& X, const Triangles& triangles, const TriangleTree& tree,
                   const Vec3& a, const Vec3& b) {
  std::vector<int> near;
  tree.find(a, b, 0, near);
  if (near.empty() && !is_inside(X, triangles, a)) return 0;
  double deepest = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const Vec3 x = a + (b - a) * (static_cast<double>(i) / kIntervals);
    const double distance = tree.distance(x);
    if (distance > deepest && is_inside(X, triangles, x)) deepest = distance;
  }
  return deepest;
}

}  // namespace articular::sim
