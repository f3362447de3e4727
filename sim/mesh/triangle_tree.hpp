#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::sim {

/// A tree of boxes over the triangles of a surface that doesn't move, for distances of points from
/// it. Each triangle's distance is that of squared_distance(), so that results are those of a loop
/// over all of them, to the last bit.
class TriangleTree {
 public:
  TriangleTree() = default;
  /// @param X          nodes [m]
  /// @param triangles  indices into X
  TriangleTree(const Positions& X, const Triangles& triangles);

  /// Whether a triangle lies within this distance of x [m], or at it.
  bool is_within(const Vec3& x, double distance) const;
  /// From the nearest triangle [m]; infinite without any.
  double distance(const Vec3& x) const;

 private:
  struct Box {
    Eigen::AlignedBox3d bounds;
    int begin = 0, end = 0;  // of a leaf: its triangles; else empty
    int right = 0;           // the left child is the next box
  };
  int build(int begin, int end);
  /// @param limit  [m²] what is farther does not count
  /// @param least  [m²] near enough to stop
  /// @return [m²] of the nearest triangle within the limit; infinite without one
  double nearest(const Vec3& x, double limit, double least) const;

  std::vector<std::array<Vec3, 3>> corners_;  // in the order of the leaves
  std::vector<Box> boxes_;
};

}  // namespace articular::sim
