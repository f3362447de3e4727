#include "collision/article/narrow_phase.hpp"

#include <algorithm>
#include <chrono>

#include "collision/mesh/element_pair.hpp"
#include "collision/narrow/narrow_test.hpp"

namespace articular::collision {

void narrow_phase(const BucketTree& F, const BucketTree& W, Reports& reports,
                  std::vector<Penetration>& pairs, QueryCounts& counts,
                  const QueryOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const double margin = 0.5 * (F.margin() + W.margin());
  for (const TriangleLists::Pair& pair : reports.tested.pairs()) {
    const Eigen::Matrix3d triangle = corners<3>(F.positions(), F.surface().faces.col(pair.face));
    const Eigen::Matrix<double, 3, 4> tetrahedron =
        corners<4>(W.positions(), W.tets().col(pair.tetrahedron));
    if (options.rule ? elements_meet(triangle, tetrahedron, margin, *options.rule)
                     : elements_overlap(triangle, tetrahedron, margin))
      reports.collisions.insert(pair.face, pair.tetrahedron);
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  counts.narrow_seconds += elapsed.count();
  counts.narrow_tests += static_cast<std::int64_t>(reports.tested.pairs().size());
  counts.reported += static_cast<std::int64_t>(reports.collisions.pairs().size());

  pairs.clear();
  for (const TriangleLists::Pair& pair : reports.collisions.pairs())
    pairs.push_back({pair.face, pair.tetrahedron});
  std::sort(pairs.begin(), pairs.end());
}

}  // namespace articular::collision
