#include "collision/blocks/topology_walk.hpp"

#include <algorithm>
#include <array>

#include "collision/mesh/element_pair.hpp"

namespace articular::collision {

Eigen::Matrix3Xi face_neighbours(const Surface& surface) {
  struct Side {
    std::array<int, 2> nodes;  // of the edge, in ascending order
    int face, edge;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  sides.reserve(3 * static_cast<std::size_t>(surface.faces.cols()));
  for (int face = 0; face < surface.faces.cols(); ++face)
    for (int k = 0; k < 3; ++k) {
      const int a = surface.faces(k, face), b = surface.faces((k + 1) % 3, face);
      sides.push_back({{std::min(a, b), std::max(a, b)}, face, k});
    }
  std::sort(sides.begin(), sides.end());

  Eigen::Matrix3Xi neighbours(3, surface.faces.cols());
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].nodes == sides[begin].nodes) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      const Side& next = sides[i + 1 < end ? i + 1 : begin];
      neighbours(sides[i].edge, sides[i].face) = end - begin > 1 ? next.face : -1;
    }
  }
  return neighbours;
}

void PairSet::clear() {
  std::fill(slots_.begin(), slots_.end(), 0);
  size_ = 0;
}

bool PairSet::insert(Penetration pair) {
  if (4 * size_ >= 3 * slots_.size()) grow();
  const std::uint64_t key =
      (static_cast<std::uint64_t>(static_cast<std::uint32_t>(pair.face)) << 32 |
       static_cast<std::uint32_t>(pair.tetrahedron)) +
      1;
  // Fibonacci hashing: the upper bits of the product mix all bits of the key.
  const std::size_t mask = slots_.size() - 1;
  std::size_t place = (key * 0x9e3779b97f4a7c15u >> 32) & mask;
  while (slots_[place] != 0) {
    if (slots_[place] == key) return false;
    place = (place + 1) & mask;
  }
  slots_[place] = key;
  ++size_;
  return true;
}

void PairSet::grow() {
  std::vector<std::uint64_t> before(std::max<std::size_t>(1024, 2 * slots_.size()), 0);
  before.swap(slots_);
  size_ = 0;
  for (const std::uint64_t key : before)
    if (key != 0)
      insert({static_cast<int>((key - 1) >> 32), static_cast<int>((key - 1) & 0xffffffffu)});
}

namespace {

/// @param admit  whether a pair counts, (face, tetrahedron)
template <class Admit>
void walk_pairs(const WalkedMesh& F, const WalkedMesh& W, std::span<const Penetration> seeds,
                std::vector<Penetration>& pairs, WalkScratch& s, WalkCounts& counts,
                Admit&& admit) {
  pairs.clear();
  s.seen.clear();
  s.candidates.clear();
  const auto offer = [&](int face, int tet) {
    if (face < 0 || tet < 0 || !s.seen.insert({face, tet}) || !admit(face, tet)) return;
    s.candidates.push_back({face, tet});
  };
  for (const Penetration& seed : seeds) offer(seed.face, seed.tetrahedron);
  // One round is all pairs one step farther from the seeds, so that many are tested at once.
  while (!s.candidates.empty()) {
    narrow_test(F.mesh, W.mesh, s.candidates, s.met, s.narrow);
    counts.candidates += static_cast<std::int64_t>(s.candidates.size());
    ++counts.rounds;
    pairs.insert(pairs.end(), s.met.begin(), s.met.end());
    s.candidates.clear();
    for (const auto& [face, tet] : s.met) {
      for (int k = 0; k < 3; ++k) offer(F.face_neighbours(k, face), tet);
      for (int k = 0; k < 4; ++k) offer(face, W.mesh.surface.neighbours(k, tet));
    }
  }
}

}  // namespace

void walk(const WalkedMesh& F, const WalkedMesh& W, std::span<const Penetration> seeds,
          std::vector<Penetration>& pairs, WalkScratch& scratch, WalkCounts& counts) {
  walk_pairs(F, W, seeds, pairs, scratch, counts, [](int, int) { return true; });
}

void walk_own_body(const WalkedMesh& mesh, std::span<const Penetration> seeds,
                   std::vector<Penetration>& pairs, WalkScratch& scratch, WalkCounts& counts) {
  walk_pairs(mesh, mesh, seeds, pairs, scratch, counts, [&](int face, int tet) {
    return !have_common_node(mesh.mesh.surface.faces, face, mesh.mesh.tets, tet);
  });
}

}  // namespace articular::collision
