#pragma once

#include <optional>

#include "fem/base/types.hpp"
#include "sim/mesh/triangle_tree.hpp"

namespace articular::sim {

/// A closed surface, to ask what lies inside.
struct Solid {
  Solid(Positions nodes, Triangles faces);

  /// Whether a ray from x passes the surface more often one way than the other. On an edge of it,
  /// seen from x, it may err; rays go askew, so that no edge of a grid is met.
  bool contains(const Vec3& x) const;

  Positions X;  // [m]
  Triangles triangles;
  TriangleTree tree;
  Eigen::AlignedBox3d box;
};

struct DeepestPoint {
  Vec3 x;            // [m]
  double depth = 0;  // from the surface [m]
};

/// The deepest of some points inside a solid; none where no point is deeper than `least` [m].
std::optional<DeepestPoint> deepest_inside(const Positions& points, const Solid& solid,
                                           double least);

}  // namespace articular::sim
