#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "collision/mesh/aabb.hpp"

namespace articular::collision {

/// Two bodies by their numbers, first < second.
struct BodyPair {
  int first, second;
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

/// Finds the bodies that may meet, before any tree of theirs is asked: a tree over their boxes,
/// made anew for each question and met with itself. Time and memory grow with the number of bodies
/// and of pairs that overlap, not with the number of all pairs, be the bodies in a row or in a
/// heap.
///
/// A node has the box of its bodies, which lie side by side in `order_`. It is halved at the median
/// of their middles, along the axis in which these spread most.
class BoxTree {
 public:
  /// The pairs of bodies whose boxes, e.g. BlockTree::bounds(), overlap (closed: boxes that touch
  /// do), in ascending order. Empty boxes overlap nothing. The result depends on the boxes alone,
  /// and is valid until the next call.
  const std::vector<BodyPair>& overlapping_bodies(std::span<const Aabb> boxes);

  /// Pairs of boxes, of bodies or of nodes, that were compared by the last call.
  std::int64_t num_tests() const { return num_tests_; }

 private:
  struct Node {
    Aabb box;
    int begin = 0, end = 0;     // of order_
    int left = -1, right = -1;  // nodes; -1: a leaf
  };
  int build(std::span<const Aabb> boxes, int begin, int end);
  void meet(std::span<const Aabb> boxes, const Node& a, const Node& b);
  void compare_bodies(std::span<const Aabb> boxes, const Node& a, const Node& b);

  std::vector<int> order_;  // the boxes that are not empty
  std::vector<Node> nodes_;
  std::vector<BodyPair> pairs_;
  std::int64_t num_tests_ = 0;
};

}  // namespace articular::collision
