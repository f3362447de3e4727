#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "collision/article/bucket_tree.hpp"
#include "collision/article/reports.hpp"
#include "collision/article/tandem.hpp"
#include "collision/mesh/penetrations.hpp"
#include "collision/narrow/narrow_rule.hpp"

/// Queries of the article's tree. One BucketTree a body; update it when its positions change, then
/// query.
namespace articular::collision {

/// Cost counters, accumulated.
struct QueryCounts {
  std::int64_t box_tests = 0;
  std::int64_t narrow_tests = 0;
  std::int64_t reported = 0;
  double narrow_seconds = 0;  // wall time inside the narrow tests
};

/// What decides on a pair of elements whose boxes overlap.
struct QueryOptions {
  /// With it elements_meet(), so that the pairs are those of the block tree; without, as the
  /// article has it, GJK (elements_overlap()).
  std::optional<NarrowTest> rule;
};

/// Memory of a query. Kept from call to call, queries do not allocate once it has grown.
struct QueryScratch {
  Reports a_in_b, b_in_a;
  std::vector<NodePair> stack;
  std::vector<int> faces_a, tets_a, faces_b, tets_b;
};

/// Surface of A against volume of B and the reverse (Listings 1.5.8 to 1.5.11). Each pair is
/// reported once, sorted by face then tetrahedron: the result does not depend on element order or
/// tree shape. With margin > 0 (the one both trees were updated with) every pair within that
/// distance is reported too (a superset: a few beyond it may be).
void collide(const BucketTree& A, const BucketTree& B, std::vector<Penetration>& faces_of_a_in_b,
             std::vector<Penetration>& faces_of_b_in_a, QueryCounts& counts);
void collide(const BucketTree& A, const BucketTree& B, std::vector<Penetration>& faces_of_a_in_b,
             std::vector<Penetration>& faces_of_b_in_a, QueryCounts& counts, QueryScratch& scratch,
             const QueryOptions& options = {});

/// A body with itself (Listing 1.5.3, errata 7 and 8): pairs (face, tetrahedron) without a common
/// node.
void self_intersections(const BucketTree& tree, std::vector<Penetration>& pairs,
                        QueryCounts& counts);
void self_intersections(const BucketTree& tree, std::vector<Penetration>& pairs,
                        QueryCounts& counts, QueryScratch& scratch,
                        const QueryOptions& options = {});

}  // namespace articular::collision
