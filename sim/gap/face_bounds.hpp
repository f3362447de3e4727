#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/gap/contact_patch.hpp"

/// Faces of a surface where they are when contacts are looked for, and what a triangle may meet of
/// them until the next time.
namespace articular::sim {

/// Extent along a direction [m].
struct Extent {
  double low, high;
};

struct FaceBounds {
  Mat3 corners;                 // one a column, counter-clockwise from outside [m]
  Vec3 normal;                  // unit
  double size;                  // longest edge [m]
  Mat3 sides;                   // in the plane, perpendicular to the edges, unit
  std::array<Extent, 3> along;  // of the face, along these
};
FaceBounds face_bounds(const Mat3& corners);

/// How the triangle s and a face may meet by motion over a distance.
struct FaceProximity {
  bool may = false;  // come to lie opposite each other within the range of depths
  bool deeper =
      false;  // lie so, seen along the triangle's normal, but deeper than the range reaches
};
FaceProximity face_proximity(const FaceBounds& s, const FaceBounds& face, const DepthRange& range,
                             double distance);

/// Whether a corner of the triangle, or its centre, lies in the tetrahedron with these corners.
bool has_corner_in(const FaceBounds& s, const Eigen::Matrix<double, 3, 4>& tetrahedron);

struct NearestFace {
  int face = -1;     // none: the surface has no faces
  double depth = 0;  // [m] distance from it, < 0 in front of it
};
/// @param among  indices into the surface: the others do not count
NearestFace nearest_face(const Vec3& x, const std::vector<FaceBounds>& surface);
NearestFace nearest_face(const Vec3& x, const std::vector<FaceBounds>& surface,
                         std::span<const int> among);

/// How deep the triangle's deepest corner, or its centre, lies below a surface [m]: the distance
/// from the nearest face; < 0 in front of it. All faces are looked at: for the few that ask.
double depth_below(const FaceBounds& s, const std::vector<FaceBounds>& surface);

}  // namespace articular::sim
