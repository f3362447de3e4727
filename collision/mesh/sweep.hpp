#pragma once

#include <span>
#include <vector>

#include "collision/mesh/aabb.hpp"

namespace articular::collision {

/// Two bodies by their numbers, first < second.
struct BodyPair {
  int first, second;
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

/// Finds the bodies that may meet, before any tree is asked: sweep and prune along one axis.
///
/// Boxes are put in the order of their low ends along the axis in which they are spread most; only
/// those that are open at the same place are compared. The order is kept from call to call, as
/// bodies move little: then putting it right takes time in proportion to their number.
class BodySweep {
 public:
  /// The pairs of bodies whose boxes, e.g. BlockTree::bounds(), overlap (closed: boxes that touch
  /// do), in ascending order. Empty boxes overlap nothing. The number of bodies may change. The
  /// result is valid until the next call.
  const std::vector<BodyPair>& overlapping_bodies(std::span<const Aabb> boxes);

 private:
  std::vector<int> order_;  // the boxes that are not empty, by their low ends
  std::vector<BodyPair> pairs_;
};

}  // namespace articular::collision
