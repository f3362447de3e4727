#include "sim/wrap/surface_walk.hpp"

#include <algorithm>

namespace articular::sim {
namespace {

struct PlaneCut {
  int edge = -1;
  double t = 0;
  Vec3 x = Vec3::Zero();
};

/// Where the plane cuts a triangle's edges other than `entry`; two of them where there is none.
int cuts_of(const PlacedSurface& surface, const Vec3& origin, const Vec3& normal, int face,
            int entry, std::array<PlaneCut, 3>& cuts) {
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    const int e = surface.surface->edge_of_face(k, face);
    if (e == entry) continue;
    const WrapEdge& edge = surface.surface->edges[static_cast<std::size_t>(e)];
    const Vec3 a = surface.at(edge.node[0]), b = surface.at(edge.node[1]);
    const double da = normal.dot(a - origin), db = normal.dot(b - origin);
    if ((da >= 0) == (db >= 0)) continue;
    const double t = std::clamp(da / (da - db), kEnd, 1 - kEnd);
    cuts[static_cast<std::size_t>(count++)] = {e, t, a + t * (b - a)};
  }
  return count;
}

}  // namespace

WalkResult walk(const PlacedSurface& surface, int surface_index, const ChordPlane& plane,
                const WalkStart& start, int target, std::vector<EdgeCrossing>& crossings) {
  constexpr double kForward = 1e-6;  // decides where the first triangle lies along the chord
  crossings.clear();
  WalkResult result;
  const Vec3 normal = plane.along.cross(plane.up);
  int face = start.face, entry = start.edge;
  Vec3 last = start.at;
  const std::size_t most = surface.surface->edges.size();
  while (crossings.size() < most) {
    std::array<PlaneCut, 3> cuts;
    const int count = cuts_of(surface, plane.from, normal, face, entry, cuts);
    if (count == 0) return result;
    const auto ahead = [&](const PlaneCut& cut) {
      return (cut.x - last).dot(plane.up + kForward * plane.along);
    };
    // From an edge that the plane only touches there are two ways too, or none.
    const PlaneCut cut = count > 1 && ahead(cuts[1]) > ahead(cuts[0]) ? cuts[1] : cuts[0];
    const double height = (cut.x - plane.from).dot(plane.up);
    if (height <= 0) {  // the chord comes out of this face
      const double drop = (last - plane.from).dot(plane.up) - height;
      const Vec3 out = drop > 0 ? Vec3(cut.x + height / drop * (cut.x - last)) : last;
      result.to_behind = (out - start.at).dot(plane.along) < 0;
      return result;
    }
    result.found = true;
    const WrapEdge& edge = surface.surface->edges[static_cast<std::size_t>(cut.edge)];
    const bool forward = edge.face[0] == face;
    crossings.push_back({surface_index, cut.edge, forward, cut.t});
    result.depth = std::max(result.depth, height);
    result.length += (cut.x - last).norm();
    last = cut.x;
    face = edge.face[forward ? 1 : 0];
    entry = cut.edge;
    result.to_border = face == -1;
    if (face == -1 || face == target) return result;
    if (face == start.face) break;
  }
  result.found = false;  // round and back
  return result;
}

}  // namespace articular::sim
