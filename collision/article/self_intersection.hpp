#pragma once

#include <span>
#include <vector>

#include "collision/article/bucket_tree.hpp"
#include "collision/article/collide.hpp"

namespace articular::collision {

/// Listing 1.5.3 for one tetrahedron Q that enters a bucket: its surface faces against the
/// tetrahedra that are in the bucket, and the faces of those against Q (erratum 7). Pairs with a
/// common node are left out (erratum 8). What is left after box test and repetition test waits in
/// `tested`.
class SelfIntersectionSearch {
 public:
  SelfIntersectionSearch(const BucketTree& tree, TriangleLists& tested, QueryCounts& counts)
      : tree_(tree), tested_(tested), counts_(counts) {}

  void operator()(int Q, std::span<const int> earlier) const;

 private:
  void faces_against(int owner, int tet) const;

  const BucketTree& tree_;
  TriangleLists& tested_;
  QueryCounts& counts_;
};

/// Listing 1.5.4 with the test inside the mapping, as the article has it: updates the tree and
/// finds its self-intersections on the way. Same pairs as update() and then self_intersections().
void update_and_find_self_intersections(BucketTree& tree, const Eigen::Matrix3Xd& x, double margin,
                                        std::vector<Penetration>& pairs, QueryCounts& counts,
                                        QueryScratch& scratch);

}  // namespace articular::collision
