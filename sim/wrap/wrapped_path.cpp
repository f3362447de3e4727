#include "sim/wrap/wrapped_path.hpp"

#include "sim/wrap/lift_off.hpp"
#include "sim/wrap/node_passage.hpp"
#include "sim/wrap/penetration.hpp"

namespace articular::sim {

int face_before(const WrapSurface& surface, const EdgeCrossing& c) {
  return surface.edges[static_cast<std::size_t>(c.edge)].face[c.forward ? 0 : 1];
}
int face_after(const WrapSurface& surface, const EdgeCrossing& c) {
  return surface.edges[static_cast<std::size_t>(c.edge)].face[c.forward ? 1 : 0];
}

bool wrap(std::span<const PlacedSurface> surfaces, WrappedString& string, WrapWork& work) {
  constexpr int kMostRounds = 1000;
  work.shape.iterations = 0;
  for (work.rounds = 1; work.rounds <= kMostRounds; ++work.rounds) {
    pull_taut(surfaces, string.from.x, string.to.x, string.crossings, work.shape);
    if (drop_lifted(surfaces, string.crossings, work.shape, work.lifted)) continue;
    if (pass_nodes(surfaces, string, work)) continue;
    if (!lead_around(surfaces, string, work)) return true;
  }
  pull_taut(surfaces, string.from.x, string.to.x, string.crossings, work.shape);
  return false;
}

}  // namespace articular::sim
