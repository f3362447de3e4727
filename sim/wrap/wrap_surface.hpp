#pragma once

#include <array>
#include <vector>

#include "sim/base/pose.hpp"
#include "sim/mesh/triangle_tree.hpp"

namespace articular::sim {

/// An edge of a surface and the triangles on it.
struct WrapEdge {
  std::array<int, 2> node{};
  /// The first has the edge from node[0] to node[1] counterclockwise, the second the other way
  /// round; -1: none, the surface ends here.
  std::array<int, 2> face{-1, -1};
};

/// A triangulated surface that strings lie on, by its connectivity alone. What lies behind the
/// triangles, which are counterclockwise from outside, is solid. It may have borders. Edges of more
/// than two triangles count as borders of those beyond the second.
struct WrapSurface {
  Triangles triangles;
  std::vector<WrapEdge> edges;
  Triangles edge_of_face;  // from corner k to corner k + 1
};

WrapSurface make_wrap_surface(const Triangles& triangles);

/// A surface where it is now.
struct PlacedSurface {
  const WrapSurface* surface = nullptr;
  const TriangleTree* tree = nullptr;  // of X
  const Positions* X = nullptr;        // in the frame of the pose [m]
  Pose pose;
  double size = 0;  // [m] of the whole: what round-off is relative to

  Vec3 at(int node) const { return pose.p + pose.R * X->col(node); }
  /// Outward and of unit length; zero of a triangle without area.
  Vec3 normal(int face) const;
};

}  // namespace articular::sim
