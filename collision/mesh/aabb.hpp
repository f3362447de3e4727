#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

namespace articular::collision {

/// Axis-aligned bounding box, closed: boxes that touch overlap. Empty until something is included.
struct Aabb {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void include(const Eigen::Vector3d& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  void include(const Aabb& box) {
    min = min.cwiseMin(box.min);
    max = max.cwiseMax(box.max);
  }
  /// Moves every side outward by distance [m].
  void inflate(double distance) {
    min.array() -= distance;
    max.array() += distance;
  }
  double longest_edge() const { return (max - min).maxCoeff(); }
};

inline bool overlap(const Aabb& a, const Aabb& b) {
  return a.min[0] <= b.max[0] && b.min[0] <= a.max[0] && a.min[1] <= b.max[1] &&
         b.min[1] <= a.max[1] && a.min[2] <= b.max[2] && b.min[2] <= a.max[2];
}

inline bool contains(const Aabb& outer, const Aabb& inner) {
  return (outer.min.array() <= inner.min.array()).all() &&
         (inner.max.array() <= outer.max.array()).all();
}

/// The box of both; only meaningful where they overlap.
inline Aabb intersection(const Aabb& a, const Aabb& b) {
  Aabb common;
  common.min = a.min.cwiseMax(b.min);
  common.max = a.max.cwiseMin(b.max);
  return common;
}

/// Box of the nodes of one element, inflated by half the margin [m].
template <class Nodes>
Aabb element_box(const Eigen::Matrix3Xd& x, const Nodes& nodes, double margin) {
  Aabb box;
  for (Eigen::Index k = 0; k < nodes.size(); ++k) box.include(Eigen::Vector3d(x.col(nodes[k])));
  box.inflate(0.5 * margin);
  return box;
}

}  // namespace articular::collision
