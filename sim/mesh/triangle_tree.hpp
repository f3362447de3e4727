#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::sim {

/// A tree of boxes over the triangles of a surface that doesn't move, for distances of points from
/// it, and for what a segment may meet. Each triangle's distance is that of squared_distance(), so
/// that results are those of a loop over all of them, to the last bit.
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
  /// Triangles whose boxes, widened by a margin [m], the segment from a to b meets, and some beside
  /// them. Their order depends on the tree alone.
  void find(const Vec3& a, const Vec3& b, double margin, std::vector<int>& found) const;

 private:
  struct Triangle {
    std::array<Vec3, 3> corners;
    int index = 0;  // of the surface
  };
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

  std::vector<Triangle> triangles_;  // in the order of the leaves
  std::vector<Box> boxes_;
};

}  // namespace articular::sim
