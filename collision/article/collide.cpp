#include "collision/article/collide.hpp"

#include "collision/article/narrow_phase.hpp"
#include "collision/article/tandem.hpp"

namespace articular::collision {
namespace {

/// The elements of two buckets that reach into the part of space the buckets share. Only they can
/// meet there.
struct BucketContents {
  const BucketTree& tree;
  std::vector<int>& faces;
  std::vector<int>& tets;

  void collect(BucketTree::Node bucket, const Aabb& shared) {
    faces.clear();
    tets.clear();
    for (int tet : tree.tets_in(bucket)) {
      if (!overlap(tree.tet_box(tet), shared)) continue;
      tets.push_back(tet);
      for (int face : tree.faces_of(tet))
        if (overlap(tree.face_box(face), shared)) faces.push_back(face);
    }
  }
};

/// Listing 1.5.10, surface of F against volume of W. The narrow test comes later, once a pair, as
/// box test and repetition test belong before it (erratum 13).
void intersection_test(const BucketContents& F, const BucketContents& W, TriangleLists& tested,
                       QueryCounts& counts) {
  for (int face : F.faces) {
    const Aabb& box = F.tree.face_box(face);
    for (int tet : W.tets)
      if (overlap(box, W.tree.tet_box(tet))) tested.insert(face, tet);
  }
  counts.box_tests += static_cast<std::int64_t>(F.faces.size() * W.tets.size());
}

}  // namespace

void collide(const BucketTree& A, const BucketTree& B, std::vector<Penetration>& faces_of_a_in_b,
             std::vector<Penetration>& faces_of_b_in_a, QueryCounts& counts, QueryScratch& scratch,
             const QueryOptions& options) {
  scratch.a_in_b.clear(A.num_faces());
  scratch.b_in_a.clear(B.num_faces());
  if (overlap(A.bounds(), B.bounds())) {
    BucketContents in_a{A, scratch.faces_a, scratch.tets_a};
    BucketContents in_b{B, scratch.faces_b, scratch.tets_b};
    tandem_traversal(A, B, scratch.stack, [&](BucketTree::Node a, BucketTree::Node b) {
      const Aabb shared = intersection(A.box(a), B.box(b));
      in_a.collect(a, shared);
      in_b.collect(b, shared);
      intersection_test(in_a, in_b, scratch.a_in_b.tested, counts);
      intersection_test(in_b, in_a, scratch.b_in_a.tested, counts);
    });
  }
  narrow_phase(A, B, scratch.a_in_b, faces_of_a_in_b, counts, options);
  narrow_phase(B, A, scratch.b_in_a, faces_of_b_in_a, counts, options);
}

void collide(const BucketTree& A, const BucketTree& B, std::vector<Penetration>& faces_of_a_in_b,
             std::vector<Penetration>& faces_of_b_in_a, QueryCounts& counts) {
  QueryScratch scratch;
  collide(A, B, faces_of_a_in_b, faces_of_b_in_a, counts, scratch);
}

}  // namespace articular::collision
