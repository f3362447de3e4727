#include "collision/blocks/narrow_list.hpp"

#include <algorithm>

#include "collision/mesh/element_pair.hpp"
#include "collision/narrow/narrow_rule.hpp"

namespace articular::collision {

namespace {

/// Pairs that are tested in one go.
constexpr std::size_t kMostPairs = 1 << 16;

void test_part(const MeshView& F, const MeshView& W, std::span<const Penetration> candidates,
               std::vector<Penetration>& pairs, NarrowListScratch& scratch,
               InstructionSet instruction_set) {
  static_assert(sizeof(Penetration) == 2 * sizeof(int));
  PairList list;
  list.face_positions = F.x.data();
  list.tet_positions = W.x.data();
  list.faces = F.surface.faces.data();
  list.tets = W.tets.data();
  list.pairs = &candidates.data()->face;
  list.num_pairs = static_cast<int>(candidates.size());
  list.accepted = scratch.accepted.data();
  list.doubtful = scratch.doubtful.data();
  list.num_accepted = list.num_doubtful = 0;
  block_kernels(instruction_set).test_pairs(list);

  for (int i = 0; i < list.num_accepted; ++i) pairs.push_back(candidates[list.accepted[i]]);
  for (int i = 0; i < list.num_doubtful; ++i) {
    const Penetration pair = candidates[list.doubtful[i]];
    if (elements_meet(corners<3>(F.x, F.surface.faces.col(pair.face)),
                      corners<4>(W.x, W.tets.col(pair.tetrahedron)), 0, NarrowTest::SeparatingAxes))
      pairs.push_back(pair);
  }
}

}  // namespace

void narrow_test(const MeshView& F, const MeshView& W, std::span<const Penetration> candidates,
                 std::vector<Penetration>& pairs, NarrowListScratch& scratch,
                 InstructionSet instruction_set) {
  pairs.clear();
  scratch.accepted.resize(std::min(kMostPairs, candidates.size()));
  scratch.doubtful.resize(std::min(kMostPairs, candidates.size()));
  for (; !candidates.empty();
       candidates = candidates.subspan(std::min(kMostPairs, candidates.size())))
    test_part(F, W, candidates.first(std::min(kMostPairs, candidates.size())), pairs, scratch,
              instruction_set);
}

}  // namespace articular::collision
