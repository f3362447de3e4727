#pragma once

#include "sim/mesh/mesh_io.hpp"
#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// A scanned sheet ends where the scan ends, with a ragged rim. This cuts it along the plane
/// through `at` across `direction`, drops what lies beyond, and carries it on from the cut: the
/// node at x0 of the cut becomes the line
///
///   x(u) = x0 + u direction + σ g(u) up,   g(u) = u − u²/2e up to the easing e, then e/2
///
/// with σ the slope that the sheet has there: without a gap, without an edge, and after the easing
/// straight. `up` is the mean normal along the cut, across the direction.
///
/// Nodes that lie near the plane are moved onto it, by at most a third of an edge, so that the cut
/// leaves no slivers. Rows of triangles are as far apart as the nodes along the cut.
/// @throws std::invalid_argument  if the plane does not cross the surface
MeshData continued(const MeshData& surface, const Continuation& continuation);

}  // namespace articular::sim
