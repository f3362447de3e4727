#include "sim/contact/pressed_area.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace articular::sim {
namespace {

/// Of a triangle, where an affine function is not negative. @param value  at its corners
double part_above(Vec3 value) {
  std::sort(value.begin(), value.end());
  if (value[0] >= 0) return 1;
  if (value[2] < 0) return 0;
  // The corner on its own side is cut off, by the parts of its two edges.
  if (value[1] < 0) return value[2] / (value[2] - value[0]) * (value[2] / (value[2] - value[1]));
  return 1 - value[0] / (value[0] - value[1]) * (value[0] / (value[0] - value[2]));
}

}  // namespace

double area_above(const std::vector<PressedTriangle>& triangles, double threshold) {
  double sum = 0;
  for (const auto& [x, p] : triangles)
    sum += 0.5 * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() *
           part_above(p.array() - threshold);
  return sum;
}

}  // namespace articular::sim
