#pragma once

#include "sim/wrap/surface_walk.hpp"

/// The locally shortest path of a string around surfaces, among the paths that it can be pulled
/// into from the one before.
namespace articular::sim {

/// A string, and the edges that it crosses in their order: its history.
struct WrappedString {
  StringEnd from, to;
  std::vector<EdgeCrossing> crossings;
};

struct WrapWork {
  StringShape shape;  // of the string, after wrap()
  StringShape other_shape;
  std::vector<EdgeCrossing> found, best, candidate;
  std::vector<int> near;
  std::vector<char> lifted;
  int rounds = 0;  // of the last wrap()
};

/// Makes the string taut and changes its sequence of edges until
///
/// - no crossing is lifted off: the string bends around what is solid at each. At an edge with
///   outward normals n, m on its sides the bend u_i − u_i−1 points inward, (u_i − u_i−1)·(n + m) <=
///   0, which it never does at a valley;
/// - no crossing wants to pass the end of its edge: if the string is shorter on the other side of
///   the node, it goes over the edges there;
/// - no segment runs through what is solid. One that does is led over the surface, along the cut
///   with a plane through the segment.
///
/// The sequence before is where it starts from. Ends inside what is solid are taken as they are.
/// @return false where it found no such path in a bounded number of changes
bool wrap(std::span<const PlacedSurface> surfaces, WrappedString& string, WrapWork& work);

/// The face that the string comes from at a crossing, and the one that it goes to; -1: none.
int face_before(const WrapSurface& surface, const EdgeCrossing& crossing);
int face_after(const WrapSurface& surface, const EdgeCrossing& crossing);

}  // namespace articular::sim
