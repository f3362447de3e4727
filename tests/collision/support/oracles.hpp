#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

/// Slow and simple answers about a triangle and a tetrahedron, found in other ways than the
/// module's.
namespace articular::collision::testing {

using Triangle = Eigen::Matrix3d;
using Tetrahedron = Eigen::Matrix<double, 3, 4>;

inline constexpr int kTetFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
inline constexpr int kTetEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

/// Largest gap that a separating axis shows [m]: positive for disjoint shapes (a lower bound of
/// their distance), negative (minus the smallest overlap) for others. For tetrahedra with volume.
inline double separating_axis_gap(const Triangle& t, const Tetrahedron& w) {
  double gap = -std::numeric_limits<double>::infinity();
  const auto try_axis = [&](const Eigen::Vector3d& axis) {
    if (!(axis.norm() > 0)) return;
    const Eigen::RowVector3d on_t = axis.normalized().transpose() * t;
    const Eigen::RowVector4d on_w = axis.normalized().transpose() * w;
    gap = std::max({gap, on_t.minCoeff() - on_w.maxCoeff(), on_w.minCoeff() - on_t.maxCoeff()});
  };
  const Eigen::Vector3d normal = (t.col(1) - t.col(0)).cross(t.col(2) - t.col(0));
  try_axis(normal);
  for (const auto& [a, b, c] : kTetFaces)
    try_axis((w.col(b) - w.col(a)).cross(w.col(c) - w.col(a)));
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d edge = t.col((i + 1) % 3) - t.col(i);
    try_axis(normal.cross(edge));
    for (const auto& [a, b] : kTetEdges) try_axis(edge.cross(w.col(b) - w.col(a)));
  }
  return gap;
}

inline double point_segment_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                     const Eigen::Vector3d& b) {
  const double length2 = (b - a).squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0;
  return (p - a - s * (b - a)).norm();
}

inline double point_triangle_distance(const Eigen::Vector3d& p, const Triangle& t) {
  double distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
    distance = std::min(distance, point_segment_distance(p, t.col(i), t.col((i + 1) % 3)));
  const Eigen::Vector3d normal = (t.col(1) - t.col(0)).cross(t.col(2) - t.col(0));
  if (!(normal.norm() > 0)) return distance;
  for (int i = 0; i < 3; ++i)  // over the inside of the triangle, the distance is that of its plane
    if ((t.col((i + 1) % 3) - t.col(i)).cross(p - t.col(i)).dot(normal) < 0) return distance;
  return std::min(distance, std::abs(normal.normalized().dot(p - t.col(0))));
}

/// Where two lines are nearest, if that is inside both segments; the ends are left to the caller.
inline double segment_segment_distance(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                                       const Eigen::Vector3d& b0, const Eigen::Vector3d& b1) {
  double distance =
      std::min({point_segment_distance(a0, b0, b1), point_segment_distance(a1, b0, b1),
                point_segment_distance(b0, a0, a1), point_segment_distance(b1, a0, a1)});
  const Eigen::Vector3d u = a1 - a0, v = b1 - b0, n = u.cross(v);
  if (!(n.squaredNorm() > 0)) return distance;
  const double s = (b0 - a0).cross(v).dot(n) / n.squaredNorm();
  const double t = (b0 - a0).cross(u).dot(n) / n.squaredNorm();
  if (s < 0 || s > 1 || t < 0 || t > 1) return distance;
  return std::min(distance, std::abs((b0 - a0).dot(n.normalized())));
}

inline bool segment_pierces(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Triangle& t) {
  const Eigen::Vector3d normal = (t.col(1) - t.col(0)).cross(t.col(2) - t.col(0));
  const double side_a = normal.dot(a - t.col(0)), side_b = normal.dot(b - t.col(0));
  if (side_a * side_b > 0 || side_a == side_b) return false;
  const Eigen::Vector3d p = a + side_a / (side_a - side_b) * (b - a);
  for (int i = 0; i < 3; ++i)
    if ((t.col((i + 1) % 3) - t.col(i)).cross(p - t.col(i)).dot(normal) < 0) return false;
  return true;
}

inline double triangle_triangle_distance(const Triangle& s, const Triangle& t) {
  double distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (segment_pierces(s.col(i), s.col((i + 1) % 3), t)) return 0;
    if (segment_pierces(t.col(i), t.col((i + 1) % 3), s)) return 0;
    distance = std::min(
        {distance, point_triangle_distance(s.col(i), t), point_triangle_distance(t.col(i), s)});
    for (int j = 0; j < 3; ++j)
      distance = std::min(distance, segment_segment_distance(s.col(i), s.col((i + 1) % 3), t.col(j),
                                                             t.col((j + 1) % 3)));
  }
  return distance;
}

/// Distance [m], 0 if they meet. Also for a flat tetrahedron: its four faces are all of it.
inline double triangle_tetrahedron_distance(const Triangle& t, const Tetrahedron& w) {
  bool inside = true;  // the first corner of the triangle, in the tetrahedron
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d a = w.col(kTetFaces[k][0]);
    const Eigen::Vector3d normal = (w.col(kTetFaces[k][1]) - a).cross(w.col(kTetFaces[k][2]) - a);
    inside = inside && normal.dot(t.col(0) - a) * normal.dot(w.col(k) - a) > 0;
  }
  if (inside) return 0;
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : kTetFaces) {
    Triangle face;
    face << w.col(a), w.col(b), w.col(c);
    distance = std::min(distance, triangle_triangle_distance(t, face));
  }
  return distance;
}

}  // namespace articular::collision::testing
