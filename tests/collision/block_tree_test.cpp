#include "collision/block_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "collision/block_collide.hpp"
#include "tests/collision/meshes.hpp"

namespace articular::collision {
namespace {

using testing::Mesh;

constexpr InstructionSet kSets[] = {InstructionSet::Baseline, InstructionSet::Avx2,
                                    InstructionSet::Avx512};

/// The instruction sets that this processor has.
std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : kSets)
    if (set <= best_instruction_set()) sets.push_back(set);
  return sets;
}

/// Every pair by the rule itself.
std::vector<Penetration> by_rule(const Mesh& F, const Eigen::Matrix3Xd& x_f, const Mesh& W,
                                 const Eigen::Matrix3Xd& x_w, double margin, NarrowTest narrow,
                                 bool one_mesh = false) {
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
  std::vector<Penetration> pairs;
  BlockQueryCounts counts;
};

Answer faces_in(const BlockTree& F, const BlockTree& W, const BlockQueryOptions& options = {}) {
  Answer answer;
  BlockQueryScratch scratch;
  if (&F == &W)
    faces_in_own_body(F, answer.pairs, answer.counts, scratch, options);
  else
    faces_in_body(F, W, answer.pairs, answer.counts, scratch, options);
  std::sort(answer.pairs.begin(), answer.pairs.end());
  return answer;
}

BlockTree tree_of(const Mesh& mesh, const Eigen::Matrix3Xd& x, double margin = 0) {
  BlockTree tree(mesh.tets, mesh.surface, mesh.X);
  tree.update(x, margin);
  return tree;
}

TEST(BlockTree, FindsWhatTheRuleFindsOnTwoDeformedBodies) {
  std::mt19937 random(1);
  const Mesh a = testing::box_mesh(7, 5, 4, 1e-3), b = testing::box_mesh(4, 4, 6, 1.3e-3);
  std::size_t found = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const Eigen::Matrix3Xd x_a = testing::jittered(a.X, 3e-4, random);
    const Eigen::Matrix3Xd x_b = testing::placed(testing::jittered(b.X, 4e-4, random),
                                                 testing::random_vector(random, 3e-3), random);
    for (const double margin : {0.0, 1e-4, 1e-3})
      for (const NarrowTest narrow : {NarrowTest::SeparatingAxes, NarrowTest::Gjk}) {
        const std::vector<Penetration> expected = by_rule(a, x_a, b, x_b, margin, narrow);
        const BlockTree A = tree_of(a, x_a, margin), B = tree_of(b, x_b, margin);
        for (const InstructionSet set : instruction_sets())
          for (const int threads : {1, 3})
            EXPECT_EQ(faces_in(A, B, {narrow, threads, set}).pairs, expected);
        found += expected.size();
      }
  }
  EXPECT_GT(found, 5000u);
}

TEST(BlockTree, FindsWhatTheRuleFindsInOneFoldedBody) {
  std::mt19937 random(2);
  const Mesh bar = testing::box_mesh(24, 3, 3, 1);
  for (const double angle : {-0.6, -0.3}) {
    const Eigen::Matrix3Xd x = testing::jittered(testing::bend_to_v(bar, angle), 0.1, random);
    for (const double margin : {0.0, 0.2}) {
      const BlockTree tree = tree_of(bar, x, margin);
      const std::vector<Penetration> expected =
          by_rule(bar, x, bar, x, margin, NarrowTest::SeparatingAxes, true);
      EXPECT_GT(expected.size(), 10u);
      for (const InstructionSet set : instruction_sets())
        EXPECT_EQ(faces_in(tree, tree, {NarrowTest::SeparatingAxes, 1, set}).pairs, expected);
    }
  }
}

TEST(BlockTree, RegularMeshDoesNotMeetItselfByEitherTest) {
  const Mesh bar = testing::box_mesh(12, 3, 3, 1);
  const BlockTree tree = tree_of(bar, testing::bend_to_v(bar, 1.5));
  for (const NarrowTest narrow : {NarrowTest::SeparatingAxes, NarrowTest::Gjk})
    EXPECT_TRUE(faces_in(tree, tree, {.narrow = narrow}).pairs.empty());
}

TEST(BlockTree, SinglePrecisionDecidesNearlyAll) {
  std::mt19937 random(3);
  const Mesh a = testing::box_mesh(12, 12, 12, 1), b = testing::box_mesh(12, 12, 12, 1);
  const BlockTree A = tree_of(a, testing::jittered(a.X, 0.1, random));
  const BlockTree B = tree_of(
      b, testing::placed(testing::jittered(b.X, 0.1, random), Eigen::Vector3d(8, 8, 8), random));
  const Answer answer = faces_in(A, B);
  EXPECT_GT(answer.counts.candidates, 5000);
  EXPECT_LT(answer.counts.doubtful, answer.counts.candidates / 200);
}

}  // namespace
}  // namespace articular::collision
