// The one place that says which narrow test the peers get.
#include "collision/blocks/narrow_list.hpp"
#include "collision/narrow/narrow_rule.hpp"
#include "tests/benchmarks/collision/peer.hpp"

namespace articular::benchmarks {

void narrow_test(const MeshView& F, const MeshView& W, std::span<const Penetration> candidates,
                 std::vector<Penetration>& pairs) {
  static collision::NarrowListScratch scratch;
  collision::narrow_test(F, W, candidates, pairs, scratch);
}

void scalar_narrow_test(const MeshView& F, const MeshView& W,
                        std::span<const Penetration> candidates, std::vector<Penetration>& pairs) {
  pairs.clear();
  for (const Penetration& pair : candidates)
    if (collision::elements_meet(collision::corners<3>(F.x, F.surface.faces.col(pair.face)),
                                 collision::corners<4>(W.x, W.tets.col(pair.tetrahedron)), 0,
                                 collision::NarrowTest::SeparatingAxes))
      pairs.push_back(pair);
}

}  // namespace articular::benchmarks
