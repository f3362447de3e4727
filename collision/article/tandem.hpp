#pragma once

#include <vector>

#include "collision/article/bucket_tree.hpp"

namespace articular::collision {

/// A node of tree A and a node of tree B that may hold elements which meet.
struct NodePair {
  BucketTree::Node a, b;
};

/// Each pair of buckets that overlap, where both are current, each in its own tree, and at least
/// one has surface, from coarse to fine (Listings 1.5.8 and 1.5.9, erratum 12).
///
/// The pairs wait on a stack: it never holds more than seven pairs a level of either tree, where
/// the queue of the listing holds a whole level. The pick is the larger node, never a bucket; A and
/// B keep their places whichever is descended.
/// @param stack  scratch memory
/// @param on_buckets  called with (bucket of A, bucket of B)
template <class OnBuckets>
void tandem_traversal(const BucketTree& A, const BucketTree& B, std::vector<NodePair>& stack,
                      OnBuckets&& on_buckets) {
  const auto push_if_alive = [&](BucketTree::Node a, BucketTree::Node b) {
    if (!A.is_current(a) || !B.is_current(b)) return;
    if (!A.has_surface(a) && !B.has_surface(b)) return;
    if (overlap(A.box(a), B.box(b))) stack.push_back({a, b});
  };
  stack.clear();
  if (A.num_tets() > 0 && B.num_tets() > 0)
    push_if_alive(BucketTree::root_node(), BucketTree::root_node());
  while (!stack.empty()) {
    const auto [a, b] = stack.back();
    stack.pop_back();
    if (A.is_bucket(a) && B.is_bucket(b)) {
      on_buckets(a, b);
      continue;
    }
    const bool pick_a = B.is_bucket(b) || (!A.is_bucket(a) && A.edge(a) >= B.edge(b));
    for (int octant = 0; octant < 8; ++octant) {
      if (pick_a)
        push_if_alive(BucketTree::child(a, octant), b);
      else
        push_if_alive(a, BucketTree::child(b, octant));
    }
  }
}

}  // namespace articular::collision
