#pragma once

#include <vector>

#include "collision/article/bucket_tree.hpp"
#include "collision/article/collide.hpp"
#include "collision/article/reports.hpp"
#include "collision/mesh/penetrations.hpp"

namespace articular::collision {

/// Narrow test of every pair in reports.tested, a face of F with a tetrahedron of W; those that
/// intersect go to reports.collisions (Listing 1.5.11) and, sorted, to pairs.
void narrow_phase(const BucketTree& F, const BucketTree& W, Reports& reports,
                  std::vector<Penetration>& pairs, QueryCounts& counts,
                  const QueryOptions& options = {});

}  // namespace articular::collision
