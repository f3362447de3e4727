#pragma once

#include <Eigen/Geometry>

#include "collision/mesh/aabb.hpp"
#include "fem/base/types.hpp"

namespace articular::sim {

/// What a body sweeps as its nodes move from one place to another, and the range of their
/// displacements [m].
struct BodySweep {
  Eigen::AlignedBox3d way, displacement;

  void add(const Vec3& from, const Vec3& to) {
    way.extend(from).extend(to);
    displacement.extend(Vec3(to - from));
  }
};

inline collision::Aabb box_of_way(const BodySweep& sweep) {
  return {sweep.way.min(), sweep.way.max()};
}

/// No two points of the bodies move farther past each other [m].
inline double most_relative_motion(const BodySweep& a, const BodySweep& b) {
  return (a.displacement.max() - b.displacement.min())
      .cwiseMax(b.displacement.max() - a.displacement.min())
      .norm();
}

}  // namespace articular::sim
