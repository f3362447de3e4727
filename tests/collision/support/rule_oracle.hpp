#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "collision/blocks/block_collide.hpp"
#include "collision/mesh/element_pair.hpp"
#include "tests/collision/support/meshes.hpp"

/// What the block tree must answer: the rule of narrow_rule.hpp applied to every pair.
namespace articular::collision::testing {

/// The instruction sets that this processor has.
inline std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set :
       {InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512})
    if (set <= best_instruction_set()) sets.push_back(set);
  return sets;
}

/// A mesh and where it is.
struct Body {
  Mesh mesh;
  Eigen::Matrix3Xd x;  // [m]
};

/// Every pair by the rule itself.
inline std::vector<Penetration> by_rule(const Mesh& F, const Eigen::Matrix3Xd& x_f, const Mesh& W,
                                        const Eigen::Matrix3Xd& x_w, double margin,
                                        NarrowTest narrow, bool one_mesh = false) {
  std::vector<Penetration> pairs;
  for (int face = 0; face < F.surface.faces.cols(); ++face) {
    const Eigen::Matrix3d triangle = corners<3>(x_f, F.surface.faces.col(face));
    for (int tet = 0; tet < W.tets.cols(); ++tet) {
      if (one_mesh && have_common_node(F.surface.faces, face, W.tets, tet)) continue;
      if (elements_meet(triangle, corners<4>(x_w, W.tets.col(tet)), margin, narrow))
        pairs.push_back({face, tet});
    }
  }
  return pairs;
}

struct Answer {
  std::vector<Penetration> pairs;  // sorted
  BlockQueryCounts counts;
};

inline Answer faces_in(const BlockTree& F, const BlockTree& W,
                       const BlockQueryOptions& options = {},
                       std::shared_ptr<ThreadPool> pool = std::make_shared<ThreadPool>(1)) {
  Answer answer;
  BlockQueryScratch scratch(std::move(pool));
  if (&F == &W)
    faces_in_own_body(F, answer.pairs, answer.counts, scratch, options);
  else
    faces_in_body(F, W, answer.pairs, answer.counts, scratch, options);
  std::sort(answer.pairs.begin(), answer.pairs.end());
  return answer;
}

inline BlockTree tree_of(const Mesh& mesh, const Eigen::Matrix3Xd& x, double margin = 0) {
  BlockTree tree(mesh.tets, mesh.surface, mesh.X);
  tree.update(x, margin);
  return tree;
}

}  // namespace articular::collision::testing
