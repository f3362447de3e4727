#pragma once

#include <span>
#include <vector>

#include "collision/brute_force.hpp"

namespace articular::benchmarks {

/// The candidates (faces of F, tetrahedra of W) that intersect, in the same order. The one place
/// that says which narrow test the peers get.
inline void narrow_test(const collision::MeshView& F, const collision::MeshView& W,
                        std::span<const collision::Penetration> candidates,
                        std::vector<collision::Penetration>& pairs) {
  pairs.clear();
  for (const collision::Penetration& pair : candidates) {
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
