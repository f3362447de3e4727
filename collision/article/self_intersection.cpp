#include "collision/article/self_intersection.hpp"

#include "collision/article/narrow_phase.hpp"
#include "collision/mesh/element_pair.hpp"

namespace articular::collision {

void SelfIntersectionSearch::operator()(int Q, std::span<const int> earlier) const {
  const bool on_surface = !tree_.faces_of(Q).empty();
  const Aabb& box = tree_.tet_box(Q);
  for (int W : earlier) {
    if (!on_surface && tree_.faces_of(W).empty()) continue;
    ++counts_.box_tests;
    if (!overlap(box, tree_.tet_box(W))) continue;
    faces_against(Q, W);
    faces_against(W, Q);
  }
}

void SelfIntersectionSearch::faces_against(int owner, int tet) const {
  for (int face : tree_.faces_of(owner)) {
    if (have_common_node(tree_.surface().faces, face, tree_.tets(), tet)) continue;
    ++counts_.box_tests;
    if (overlap(tree_.face_box(face), tree_.tet_box(tet))) tested_.insert(face, tet);
  }
}

void update_and_find_self_intersections(BucketTree& tree, const Eigen::Matrix3Xd& x, double margin,
                                        std::vector<Penetration>& pairs, QueryCounts& counts,
                                        QueryScratch& scratch) {
  Reports& reports = scratch.a_in_b;
  reports.clear(tree.num_faces());
  tree.update(x, margin, SelfIntersectionSearch(tree, reports.tested, counts));
  narrow_phase(tree, tree, reports, pairs, counts);
}

void self_intersections(const BucketTree& tree, std::vector<Penetration>& pairs,
                        QueryCounts& counts, QueryScratch& scratch, const QueryOptions& options) {
  Reports& reports = scratch.a_in_b;
  reports.clear(tree.num_faces());
  const SelfIntersectionSearch search(tree, reports.tested, counts);
  // The mapping once more, bucket by bucket: each tetrahedron meets those added before it.
  for (int i = 0; i < tree.num_non_empty_buckets(); ++i) {
    const std::span<const int> bucket = tree.non_empty_bucket(i);
    for (std::size_t k = 1; k < bucket.size(); ++k) search(bucket[k], bucket.first(k));
  }
  narrow_phase(tree, tree, reports, pairs, counts, options);
}

void self_intersections(const BucketTree& tree, std::vector<Penetration>& pairs,
                        QueryCounts& counts) {
  QueryScratch scratch;
  self_intersections(tree, pairs, counts, scratch);
}

}  // namespace articular::collision
