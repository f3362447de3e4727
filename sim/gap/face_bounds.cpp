#include "sim/gap/face_bounds.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/mesh/triangle_distance.hpp"

namespace articular::sim {
namespace {

Extent extent_along(const Mat3& triangle, const Vec3& direction) {
  const double p = direction.dot(triangle.col(0)), q = direction.dot(triangle.col(1)),
               r = direction.dot(triangle.col(2));
  return {std::min({p, q, r}), std::max({p, q, r})};
}

bool apart(const Extent& a, const Extent& b, double distance) {
  return a.low - b.high > distance || b.low - a.high > distance;
}

/// Seen along the triangle's normal, the face is beside it.
bool beside(const FaceBounds& s, const FaceBounds& F, double distance) {
  for (int k = 0; k < 3; ++k)
    if (apart(s.along[static_cast<std::size_t>(k)], extent_along(F.corners, s.sides.col(k)),
              distance))
      return true;
  for (int k = 0; k < 3; ++k) {
    const Vec3 side =
        (F.corners.col((k + 1) % 3) - F.corners.col(k)).cross(s.normal);  // of any length
    if (apart(extent_along(s.corners, side), extent_along(F.corners, side), distance * side.norm()))
      return true;
  }
  return false;
}

}  // namespace

FaceBounds face_bounds(const Mat3& corners) {
  FaceBounds face;
  const Mat3& p = face.corners = corners;
  face.normal = (p.col(1) - p.col(0)).cross(p.col(2) - p.col(0)).normalized();
  face.size =
      std::sqrt(std::max({(p.col(1) - p.col(0)).squaredNorm(), (p.col(2) - p.col(1)).squaredNorm(),
                          (p.col(0) - p.col(2)).squaredNorm()}));
  for (int k = 0; k < 3; ++k) {
    face.sides.col(k) = (p.col((k + 1) % 3) - p.col(k)).cross(face.normal).normalized();
    face.along[static_cast<std::size_t>(k)] = extent_along(p, face.sides.col(k));
  }
  return face;
}

FaceProximity face_proximity(const FaceBounds& s, const FaceBounds& face, const DepthRange& range,
                             double distance) {
  const double plane = s.normal.dot(s.corners.col(0));
  const Extent height = extent_along(face.corners, s.normal);
  if (height.low - plane > range.open + distance || beside(s, face, distance)) return {};
  return {plane - height.high <= range.reach + distance, plane - height.low > range.reach};
}

namespace {

/// @param at  the index in the surface of the k-th face
template <class At>
NearestFace nearest_of(const Vec3& x, const std::vector<FaceBounds>& surface, std::size_t count,
                       At&& at) {
  // Faces as near as this part of the distance share the edge or corner that is nearest; the one
  // that the point lies farthest off, seen along its normal, knows the side.
  constexpr double kSame = 1e-9;
  NearestFace nearest;
  double least = std::numeric_limits<double>::infinity(), depth = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const FaceBounds& face = surface[at(k)];
    const double farthest = (least + face.size) * (1 + kSame);
    if ((face.corners.col(0) - x).squaredNorm() > farthest * farthest) continue;
    const double distance = std::sqrt(
        squared_distance(x, face.corners.col(0), face.corners.col(1), face.corners.col(2)));
    if (distance > least * (1 + kSame)) continue;
    const double below = face.normal.dot(face.corners.col(0) - x);
    if (distance >= least * (1 - kSame) && std::abs(below) <= std::abs(depth)) continue;
    least = std::min(least, distance);
    depth = below;
    nearest.face = static_cast<int>(at(k));
  }
  nearest.depth = std::copysign(least, depth);
  return nearest;
}

}  // namespace

NearestFace nearest_face(const Vec3& x, const std::vector<FaceBounds>& surface) {
  return nearest_of(x, surface, surface.size(), [](std::size_t k) { return k; });
}

NearestFace nearest_face(const Vec3& x, const std::vector<FaceBounds>& surface,
                         std::span<const int> among) {
  return nearest_of(x, surface, among.size(),
                    [&](std::size_t k) { return static_cast<std::size_t>(among[k]); });
}

bool has_corner_in(const FaceBounds& s, const Eigen::Matrix<double, 3, 4>& tetrahedron) {
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = tetrahedron.col(k + 1) - tetrahedron.col(0);
  Mat3 inverse;
  bool invertible = false;
  edges.computeInverseWithCheck(inverse, invertible, 0);
  if (!invertible) return false;
  const auto is_in = [&](const Vec3& x) {
    const Vec3 weights = inverse * (x - tetrahedron.col(0));
    return weights.minCoeff() >= 0 && weights.sum() <= 1;
  };
  return is_in(s.corners.rowwise().mean()) || is_in(s.corners.col(0)) || is_in(s.corners.col(1)) ||
         is_in(s.corners.col(2));
}

double depth_below(const FaceBounds& s, const std::vector<FaceBounds>& surface) {
  double deepest = nearest_face(s.corners.rowwise().mean(), surface).depth;
  for (const auto& corner : s.corners.colwise())
    deepest = std::max(deepest, nearest_face(corner, surface).depth);
  return deepest;
}

}  // namespace articular::sim
