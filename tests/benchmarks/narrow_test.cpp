// The one place that says which narrow test the peers get.
#include "tests/benchmarks/peer.hpp"

namespace articular::benchmarks {

void narrow_test(const MeshView& F, const MeshView& W, std::span<const Penetration> candidates,
                 std::vector<Penetration>& pairs) {
  pairs.clear();
  for (const Penetration& pair : candidates) {
    const Eigen::Vector3i face = F.surface.faces.col(pair.face);
    const Eigen::Vector4i tet = W.tets.col(pair.tetrahedron);
    // Boxes in single precision let through what the exact ones do not.
    if (!overlap(collision::element_box(F.x, face, 0), collision::element_box(W.x, tet, 0)))
      continue;
    if (collision::elements_overlap(collision::corners<3>(F.x, face),
                                    collision::corners<4>(W.x, tet), 0))
      pairs.push_back(pair);
  }
}

}  // namespace articular::benchmarks
