#pragma once

#include <vector>

#include "sim/model/configuration.hpp"

namespace articular::sim {

/// Two bodies that lie in each other and that nothing parts: no [[contact]] names them.
struct IgnoredOverlap {
  int inner = 0, outer = 0;  // indices into Model::bodies: a node of `inner` lies in `outer`
  Vec3 x;                    // [m], the deepest node
  double depth = 0;          // [m]
  bool is_whole = false;     // all nodes of `inner` lie there
};

/// Whichever of the two lies in the other.
bool are_of_same_bodies(const IgnoredOverlap& a, const IgnoredOverlap& b);

/// Those that are deeper than half an element of their tissues, or than a fiftieth of the smaller
/// body where both are rigid. Left out: bodies with `collides = false` or with contact meshes of
/// their own, tissue that is tied to the other, two bodies that are fixed or driven, and open
/// surfaces.
std::vector<IgnoredOverlap> ignored_overlaps(const Scenario& scenario, const Model& model,
                                             const Configuration& now);

}  // namespace articular::sim
