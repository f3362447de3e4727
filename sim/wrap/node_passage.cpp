#include "sim/wrap/node_passage.hpp"

#include <algorithm>

#include "sim/wrap/lift_off.hpp"

namespace articular::sim {
namespace {

/// Of a face's edges at a node, the one that is not `edge`.
int other_edge(const WrapSurface& surface, int face, int node, int edge) {
  for (int k = 0; k < 3; ++k) {
    const int e = surface.edge_of_face(k, face);
    const WrapEdge& candidate = surface.edges[static_cast<std::size_t>(e)];
    if (e != edge && (candidate.node[0] == node || candidate.node[1] == node)) return e;
  }
  return edge;
}

/// From the face around the node, away from `edge`, until the face `to`. Face -1 lies beyond a
/// border. @return false where the surface ends before
bool go_round(const WrapSurface& surface, int surface_index, int node, int face, int edge, int to,
              std::vector<EdgeCrossing>& crossings) {
  constexpr double kAway = 0.1;  // of the edge, from the node
  constexpr int kMostEdges = 1000;
  for (int k = 0; face != to && k < kMostEdges; ++k) {
    if (face < 0) return false;
    edge = other_edge(surface, face, node, edge);
    const WrapEdge& e = surface.edges[static_cast<std::size_t>(edge)];
    const bool forward = e.face[0] == face;
    crossings.push_back({surface_index, edge, forward, e.node[0] == node ? kAway : 1 - kAway});
    face = e.face[forward ? 1 : 0];
  }
  return face == to;
}

/// The edges on the other side of a node for a run of crossings on this one; none where the
/// surface ends there.
void other_side(const WrapSurface& surface, int node, std::span<const EdgeCrossing> run,
                std::vector<EdgeCrossing>& crossings) {
  crossings.clear();
  const int before = face_before(surface, run.front()), after = face_after(surface, run.back());
  const int index = run.front().surface;
  bool found = before == after;
  if (!found && before >= 0) {
    found = go_round(surface, index, node, before, run.front().edge, after, crossings);
  } else if (!found) {
    found = go_round(surface, index, node, after, run.back().edge, before, crossings);
    turn_round(crossings);
  }
  if (!found) crossings.clear();
}

/// Crossings as near to a node as this, by their edges, lie at it if one of them is at its bound:
/// the others may keep a little off.
constexpr double kAtNode = 1e-5;

bool is_near(std::span<const PlacedSurface> surfaces, const EdgeCrossing& crossing, int surface,
             int node) {
  if (crossing.surface != surface) return false;
  const WrapEdge& edge = surfaces[static_cast<std::size_t>(surface)]
                             .surface->edges[static_cast<std::size_t>(crossing.edge)];
  return (edge.node[0] == node && crossing.t < kAtNode) ||
         (edge.node[1] == node && crossing.t > 1 - kAtNode);
}

bool is_at(std::span<const PlacedSurface> surfaces, const std::vector<EdgeCrossing>& crossings,
           int surface, int node) {
  return std::any_of(crossings.begin(), crossings.end(), [&](const EdgeCrossing& c) {
    return c.surface == surface &&
           node_at_end(*surfaces[static_cast<std::size_t>(surface)].surface, c) == node;
  });
}

}  // namespace

bool pass_nodes(std::span<const PlacedSurface> surfaces, WrappedString& string, WrapWork& work) {
  constexpr double kGain = 20 * kEnd;  // of an edge: what lies apart for kEnd alone is no longer
  std::vector<EdgeCrossing>& crossings = string.crossings;
  bool any = false;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const int index = crossings[i].surface;
    const WrapSurface& surface = *surfaces[static_cast<std::size_t>(index)].surface;
    const int node = node_at_end(surface, crossings[i]);
    if (node < 0) continue;
    std::size_t begin = i, end = i + 1;
    while (begin > 0 && is_near(surfaces, crossings[begin - 1], index, node)) --begin;
    while (end < crossings.size() && is_near(surfaces, crossings[end], index, node)) ++end;
    const double edge = work.shape.e[i].norm();
    other_side(surface, node, std::span(crossings).subspan(begin, end - begin), work.found);
    const auto at = [&](std::size_t k) {
      return crossings.begin() + static_cast<std::ptrdiff_t>(k);
    };
    work.candidate.assign(crossings.begin(), at(begin));
    work.candidate.insert(work.candidate.end(), work.found.begin(), work.found.end());
    work.candidate.insert(work.candidate.end(), at(end), crossings.end());
    work.other_shape.iterations = work.shape.iterations;
    do {
      pull_taut(surfaces, string.from.x, string.to.x, work.candidate, work.other_shape);
    } while (drop_lifted(surfaces, work.candidate, work.other_shape, work.lifted));
    const double gain = work.shape.length - work.other_shape.length;
    work.shape.iterations = work.other_shape.iterations;
    if (gain > kGain * edge ||
        (gain > -kGain * edge && !is_at(surfaces, work.candidate, index, node))) {
      std::swap(crossings, work.candidate);
      std::swap(work.shape, work.other_shape);
      any = true;
    } else {
      i = end - 1;
    }
  }
  return any;
}

}  // namespace articular::sim
