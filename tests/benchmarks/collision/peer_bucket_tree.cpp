// The article's method to the letter, errata aside: BucketTree, tandem traversal, self-intersection
// while mapping, repetition test, and GJK for every pair that is left. collide() in collision/ may
// know better ways.
#include "collision/article/self_intersection.hpp"
#include "collision/article/tandem.hpp"
#include "collision/narrow/gjk.hpp"
#include "tests/benchmarks/collision/peer.hpp"

namespace articular::benchmarks {
namespace {

using collision::Aabb;
using collision::BucketTree;
using collision::TriangleLists;

/// What of a bucket reaches into the part of space that it shares with another.
struct Contents {
  std::vector<int> faces, tets;

  void collect(const BucketTree& tree, BucketTree::Node bucket, const Aabb& shared) {
    faces.clear();
    tets.clear();
    for (const int tet : tree.tets_in(bucket)) {
      if (!overlap(tree.tet_box(tet), shared)) continue;
      tets.push_back(tet);
      for (const int face : tree.faces_of(tet))
        if (overlap(tree.face_box(face), shared)) faces.push_back(face);
    }
  }
};

/// Listing 1.5.10, one direction.
void surface_against_volume(const BucketTree& F, const Contents& f, const BucketTree& W,
                            const Contents& w, TriangleLists& pairs) {
  for (const int face : f.faces)
    for (const int tet : w.tets)
      if (overlap(F.face_box(face), W.tet_box(tet))) pairs.insert(face, tet);
}

class BucketTreeSearch final : public BroadPhase {
 public:
  void update(std::span<const MeshView> bodies) override {
    if (trees_.empty())
      for (const MeshView& body : bodies) trees_.emplace_back(body.tets, body.surface, body.x);
    for (std::size_t k = 0; k < trees_.size(); ++k) pairs_[k].clear(trees_[k].num_faces());
    if (trees_.size() == 1) {
      collision::QueryCounts counts;
      trees_[0].update(bodies[0].x, 0,
                       collision::SelfIntersectionSearch(trees_[0], pairs_[0], counts));
      return;
    }
    for (std::size_t k = 0; k < 2; ++k) trees_[k].update(bodies[k].x);
    traverse(trees_[0], trees_[1]);
  }

  void find(std::size_t faces_of, std::size_t, Candidates& candidates) override {
    for (const TriangleLists::Pair& pair : pairs_[faces_of].pairs())
      candidates.add(pair.face, pair.tetrahedron);
  }

 private:
  void traverse(const BucketTree& A, const BucketTree& B) {
    if (!overlap(A.bounds(), B.bounds())) return;
    collision::tandem_traversal(A, B, stack_, [&](BucketTree::Node a, BucketTree::Node b) {
      const Aabb shared = intersection(A.box(a), B.box(b));
      in_a_.collect(A, a, shared);
      in_b_.collect(B, b, shared);
      surface_against_volume(A, in_a_, B, in_b_, pairs_[0]);
      surface_against_volume(B, in_b_, A, in_a_, pairs_[1]);
    });
  }

  std::vector<BucketTree> trees_;
  std::vector<collision::NodePair> stack_;
  Contents in_a_, in_b_;
  std::array<TriangleLists, 2> pairs_;
};

}  // namespace

std::unique_ptr<BroadPhase> bucket_tree() { return std::make_unique<BucketTreeSearch>(); }

void gjk_test(const MeshView& F, const MeshView& W, std::span<const Penetration> candidates,
              std::vector<Penetration>& pairs) {
  pairs.clear();
  for (const Penetration& pair : candidates) {
    const Eigen::Matrix3d face = collision::corners<3>(F.x, F.surface.faces.col(pair.face));
    const Eigen::Matrix<double, 3, 4> tet =
        collision::corners<4>(W.x, W.tets.col(pair.tetrahedron));
    const collision::GjkOutcome outcome = collision::gjk(face, tet);
    // libccd gives up on one pair in some ten million that the planes of the faces hold apart. All
    // must report the same.
    if (outcome == collision::GjkOutcome::Intersecting ||
        (outcome == collision::GjkOutcome::Undecided && collision::elements_overlap(face, tet, 0)))
      pairs.push_back(pair);
  }
}

}  // namespace articular::benchmarks
