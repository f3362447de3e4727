#pragma once

#include "collision/narrow_list.hpp"

namespace articular::benchmarks {

/// The candidates (faces of F, tetrahedra of W) that intersect, in any order. The one place that
/// says which narrow test the peers get.
inline void narrow_test(const collision::MeshView& F, const collision::MeshView& W,
                        std::span<const collision::Penetration> candidates,
                        std::vector<collision::Penetration>& pairs) {
  static collision::NarrowListScratch scratch;
  collision::narrow_test(F, W, candidates, pairs, scratch);
}

}  // namespace articular::benchmarks
