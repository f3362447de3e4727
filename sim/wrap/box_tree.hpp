#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::sim {

/// A tree of boxes over triangles whose nodes may move: which of them a segment may meet.
class BoxTree {
 public:
  BoxTree() = default;
  BoxTree(const Positions& X, const Triangles& triangles);

  /// The boxes where the nodes are now; which triangles lie together stays as it was.
  void refit(const Positions& X, const Triangles& triangles);
  /// Triangles whose boxes, widened by a margin [m], the segment from a to b meets. Their order
  /// depends on the tree alone.
  void find(const Vec3& a, const Vec3& b, double margin, std::vector<int>& found) const;

 private:
  struct Box {
    Eigen::AlignedBox3d bounds;
    int begin = 0, end = 0;  // of a leaf: its triangles; else empty
    int right = 0;           // the left child is the next box
  };
  int build(const Positions& X, const Triangles& triangles, int begin, int end);

  std::vector<int> order_;
  std::vector<Box> boxes_;
};

}  // namespace articular::sim
