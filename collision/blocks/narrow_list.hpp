#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "collision/blocks/block_kernels.hpp"
#include "collision/mesh/penetrations.hpp"
#include "collision/narrow/brute_force.hpp"

namespace articular::collision {

/// Memory of narrow_test(), kept from call to call.
struct NarrowListScratch {
  std::vector<std::uint32_t> accepted, doubtful;
};

/// Of pairs (face of F, tetrahedron of W) from a broad phase of the caller's those that
/// elements_meet() without a margin, in no particular order: sixteen at once.
void narrow_test(const MeshView& F, const MeshView& W, std::span<const Penetration> candidates,
                 std::vector<Penetration>& pairs, NarrowListScratch& scratch,
                 InstructionSet instruction_set = best_instruction_set());

}  // namespace articular::collision
