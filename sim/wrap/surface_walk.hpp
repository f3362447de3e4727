#pragma once

#include <vector>

#include "sim/wrap/taut_string.hpp"

namespace articular::sim {

/// A plane through a chord, and which way of it the walk goes round what is in the chord's way.
struct ChordPlane {
  Vec3 from = Vec3::Zero();   // [m]
  Vec3 along = Vec3::Zero();  // unit vector, the chord's
  Vec3 up = Vec3::Zero();     // unit vector normal to the chord: away from what is in its way
};

/// Where a walk begins: on a triangle, or on an edge of it that it has come over.
struct WalkStart {
  int face = 0, edge = -1;
  Vec3 at = Vec3::Zero();  // [m]
};

struct WalkResult {
  bool found = false;
  bool to_border = false;
  bool to_behind = false;  // the chord comes out of the surface behind where the walk began
  double depth = 0;        // [m] how far the chord lies below the surface, at most
  double length = 0;       // [m] of the walk
};

/// The edges that the plane cuts out of a surface, from the start to where the chord is above the
/// surface again, to the face `target`, or to a border. Nodes in the plane count as above it, so
/// that the plane goes into each triangle once and out once.
WalkResult walk(const PlacedSurface& surface, int surface_index, const ChordPlane& plane,
                const WalkStart& start, int target, std::vector<EdgeCrossing>& crossings);

}  // namespace articular::sim
