#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "collision/mesh/element_pair.hpp"
#include "collision/narrow/brute_force.hpp"

/// What the measured ways of finding pairs have in common.
namespace articular::benchmarks {

using collision::MeshView;
using collision::Penetration;

/// Result of a query. Two bodies A and B: faces of A in B, faces of B in A. One body: with itself.
using Found = std::array<std::vector<Penetration>, 2>;

/// One way of doing the whole query.
class Peer {
 public:
  virtual ~Peer() = default;
  /// From new positions to the pairs that intersect, in any order.
  /// @param bodies  one or two, the same meshes at every call
  virtual void query(std::span<const MeshView> bodies, Found& found) = 0;
  /// Seconds of the last query inside the narrow test.
  virtual double narrow_seconds() const = 0;
  /// Memory, if malloc does not know all of it.
  virtual std::optional<std::size_t> bytes() const { return {}; }
};

/// The pairs with overlapping boxes of one query, as a broad phase finds them.
class Candidates {
 public:
  /// @param faces  the mesh that the faces belong to; if it is also that of the tetrahedra, pairs
  ///               with a common node are left out
  Candidates(const MeshView& faces, const MeshView& tets, std::vector<Penetration>& pairs)
      : faces_(faces), tets_(tets), same_(&faces.tets == &tets.tets), pairs_(pairs) {}

  void add(int face, int tet) {
    if (same_ && collision::have_common_node(faces_.surface.faces, face, tets_.tets, tet)) return;
    pairs_.push_back({face, tet});
  }

 private:
  const MeshView& faces_;
  const MeshView& tets_;
  bool same_;
  std::vector<Penetration>& pairs_;
};

/// A way of finding candidates. May report pairs whose boxes are apart by the rounding to single
/// precision; no pair twice.
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;
  virtual void update(std::span<const MeshView> bodies) = 0;
  /// Faces of one body against tetrahedra of another, or the same.
  virtual void find(std::size_t faces_of, std::size_t tets_of, Candidates& candidates) = 0;
  virtual std::optional<std::size_t> bytes() const { return {}; }
};

/// The candidates (faces of F, tetrahedra of W) that intersect go to pairs, in any order.
using NarrowTest = void (*)(const MeshView& F, const MeshView& W,
                            std::span<const Penetration> candidates,
                            std::vector<Penetration>& pairs);
/// The one that the peers have in common.
void narrow_test(const MeshView& F, const MeshView& W, std::span<const Penetration> candidates,
                 std::vector<Penetration>& pairs);
/// The same without vectors: pair by pair in double precision.
void scalar_narrow_test(const MeshView& F, const MeshView& W,
                        std::span<const Penetration> candidates, std::vector<Penetration>& pairs);
/// The article's: nothing but GJK. Takes exact boxes for granted.
void gjk_test(const MeshView& F, const MeshView& W, std::span<const Penetration> candidates,
              std::vector<Penetration>& pairs);

/// The broad phase with a narrow test behind it.
std::unique_ptr<Peer> with_narrow_test(std::unique_ptr<BroadPhase> broad_phase,
                                       NarrowTest test = narrow_test);

std::unique_ptr<Peer> block_tree_peer(std::span<const MeshView> bodies);
std::unique_ptr<Peer> article_peer(std::span<const MeshView> bodies);
std::unique_ptr<BroadPhase> bucket_tree();
std::unique_ptr<BroadPhase> spatial_hash();
std::unique_ptr<BroadPhase> cgal_box_intersection();
std::unique_ptr<BroadPhase> embree_rebuilt();
std::unique_ptr<BroadPhase> embree_refitted();
std::unique_ptr<BroadPhase> fcl_refitted();

}  // namespace articular::benchmarks
