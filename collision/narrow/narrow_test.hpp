#pragma once

#include "collision/narrow/face_planes.hpp"
#include "collision/narrow/gjk.hpp"

namespace articular::collision {

/// Whether a triangle and a tetrahedron are within the margin [m] of each other: GJK, where the
/// planes of their faces do not tell already. The rule of the
/// article's tree; the block tree has elements_meet().
inline bool elements_overlap(const Eigen::Matrix3d& triangle,
                             const Eigen::Matrix<double, 3, 4>& tetrahedron, double margin) {
  const PlaneVerdict verdict = face_planes(triangle, tetrahedron, margin);
  if (verdict != PlaneVerdict::Unknown) return verdict == PlaneVerdict::Overlapping;
  return gjk_overlap(triangle, tetrahedron, margin);
}

}  // namespace articular::collision
