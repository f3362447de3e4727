#include "sim/wrap/lift_off.hpp"

#include <algorithm>

namespace articular::sim {
namespace {

/// Bends smaller than this are none [rad].
constexpr double kLeastBend = 1e-10;
constexpr double kEpsilon = 1e-15;  // of coordinates

/// Of the two sides of an edge, outward. Where the surface ends it is taken to go down there.
Vec3 outward(const PlacedSurface& placed, const WrapEdge& edge) {
  const Vec3 n = placed.normal(edge.face[0]);
  if (edge.face[1] >= 0) return n + placed.normal(edge.face[1]);
  const Vec3 along = placed.at(edge.node[1]) - placed.at(edge.node[0]);
  return n + along.cross(n).normalized();
}

bool is_back(const EdgeCrossing& c, const EdgeCrossing& d) {
  return c.surface == d.surface && c.edge == d.edge;
}

/// What goes over an edge and back has not gone over it; what goes over it twice has once.
bool drop_returns(std::vector<EdgeCrossing>& crossings) {
  const std::size_t before = crossings.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < before; ++i) {
    if (kept > 0 && is_back(crossings[kept - 1], crossings[i])) {
      if (crossings[kept - 1].forward != crossings[i].forward) --kept;
      continue;
    }
    crossings[kept++] = crossings[i];
  }
  crossings.resize(kept);
  return kept != before;
}

}  // namespace

bool drop_lifted(std::span<const PlacedSurface> surfaces, std::vector<EdgeCrossing>& crossings,
                 const StringShape& s, std::vector<char>& lifted) {
  lifted.assign(crossings.size(), 0);
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const PlacedSurface& placed = surfaces[static_cast<std::size_t>(crossings[i].surface)];
    const WrapEdge& edge = placed.surface->edges[static_cast<std::size_t>(crossings[i].edge)];
    // The shorter a segment, the more of its direction is round-off.
    const double shortest = std::min(s.l[i], s.l[i + 1]);
    const double least = kLeastBend + (shortest > 0 ? kEpsilon * placed.size / shortest : 1);
    lifted[i] = (s.u[i + 1] - s.u[i]).dot(outward(placed, edge)) > least;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < crossings.size(); ++i)
    if (lifted[i] == 0) crossings[kept++] = crossings[i];
  const bool any = kept != crossings.size();
  crossings.resize(kept);
  return drop_returns(crossings) || any;
}

}  // namespace articular::sim
