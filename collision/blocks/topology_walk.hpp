#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/blocks/narrow_list.hpp"
#include "collision/mesh/penetrations.hpp"
#include "collision/narrow/brute_force.hpp"

/// The article's future work 1: search a zone of interpenetration along the topology of the meshes
/// ("Conclusion").
///
/// From pairs that are known to meet (seeds), breadth first over pairs (face, tetrahedron): a
/// pair's neighbours have a face that shares an edge, or a tetrahedron that shares a face, and from
/// those that meet the search goes on. The pairs of one connected contact are connected in this
/// way: the surface of F within W is cut by W's tetrahedra into pieces that border each other.
///
/// What it cannot do: a contact region without a seed is not found. The pairs of the last time step
/// as seeds lose every new region until a tree finds it, so that this is no default. Nor is it
/// faster: on V-shapes of 10 k and 100 k tetrahedra the walk from the last frame's pairs takes 1.9
/// to 2.1 times as long as update and search of the block tree for two bodies, 0.89 to 1.03 times
/// for one that crosses itself, and loses some pairs in both (medians of interleaved runs,
/// tests/benchmarks/collision/topology_walk.cpp).
namespace articular::collision {

/// Column f, row k: the face across the edge from node k to node k + 1 of face f. Where more than
/// two faces meet at an edge (a mesh that touches itself there), each has the next of a ring; -1 if
/// there is no other.
Eigen::Matrix3Xi face_neighbours(const Surface& surface);

struct WalkedMesh {
  MeshView mesh;
  const Eigen::Matrix3Xi& face_neighbours;
};

/// A set of pairs: hashing with open addressing. Slots hold pairs as numbers, 0 if empty.
class PairSet {
 public:
  void clear();
  /// @return whether the pair is new
  bool insert(Penetration pair);
  std::size_t memory() const { return slots_.capacity() * sizeof(std::uint64_t); }

 private:
  void grow();
  std::vector<std::uint64_t> slots_;
  std::size_t size_ = 0;
};

/// Memory of a walk, kept from call to call.
struct WalkScratch {
  PairSet seen;
  std::vector<Penetration> candidates, met;
  NarrowListScratch narrow;
};

struct WalkCounts {
  std::int64_t candidates = 0;  // pairs tested
  std::int64_t rounds = 0;      // steps away from the seeds
};

/// The pairs (face of F, tetrahedron of W) that meet (elements_meet() without a margin) and are
/// connected to a seed that meets; each once, in no particular order. Seeds that do not meet (any
/// more) are not searched from.
/// @param seeds  any pairs, e.g. those of the last time step; must not be in `pairs`
void walk(const WalkedMesh& F, const WalkedMesh& W, std::span<const Penetration> seeds,
          std::vector<Penetration>& pairs, WalkScratch& scratch, WalkCounts& counts);

/// The same in one body, where pairs with a common node (erratum 8) are left out. They are not
/// searched across either, as they connect the whole surface.
void walk_own_body(const WalkedMesh& mesh, std::span<const Penetration> seeds,
                   std::vector<Penetration>& pairs, WalkScratch& scratch, WalkCounts& counts);

}  // namespace articular::collision
