#include "collision/blocks/block_tree.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/collision/support/rule_oracle.hpp"

namespace articular::collision::block_tree_test {

using testing::Answer;
using testing::by_rule;
using testing::faces_in;
using testing::instruction_sets;
using testing::Mesh;
using testing::tree_of;

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
            EXPECT_EQ(faces_in(A, B, {narrow, set}, std::make_shared<ThreadPool>(threads)).pairs,
                      expected);
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
        EXPECT_EQ(faces_in(tree, tree, {NarrowTest::SeparatingAxes, set}).pairs, expected);
    }
  }
}

TEST(BlockTree, RegularMeshDoesNotMeetItselfByEitherTest) {
  const Mesh bar = testing::box_mesh(12, 3, 3, 1);
  const BlockTree tree = tree_of(bar, testing::bend_to_v(bar, 1.5));
  for (const NarrowTest narrow : {NarrowTest::SeparatingAxes, NarrowTest::Gjk})
    EXPECT_TRUE(faces_in(tree, tree, {.narrow = narrow}).pairs.empty());
}

TEST(BlockTree, MovedAndFittedIsUpdated) {
  std::mt19937 random(4);
  const Mesh a = testing::box_mesh(4, 4, 4, 1), b = testing::box_mesh(4, 4, 4, 1);
  BlockTree A = tree_of(a, a.X.array() + 9), B = tree_of(b, b.X);
  const Eigen::Matrix3Xd x = testing::placed(a.X, Eigen::Vector3d(1, 2, 3), random);
  A.move(x);
  EXPECT_EQ(A.bounds().min, tree_of(a, x).bounds().min);
  EXPECT_EQ(A.bounds().max, tree_of(a, x).bounds().max);
  EXPECT_THROW(faces_in(A, B), std::invalid_argument);
  EXPECT_THROW(faces_in(B, A), std::invalid_argument);
  A.fit();
  const Answer answer = faces_in(A, B);
  EXPECT_EQ(answer.pairs, faces_in(tree_of(a, x), B).pairs);
  EXPECT_GT(answer.pairs.size(), 100u);
}

// A long bar has several groups of blocks; the probe visits them all while the bar moves on and
// turns. Boxes lie in a frame that moves with the bar: it must turn for old ones to be wrong.
TEST(BlockTree, FollowsEveryUpdateInAllOfItsBlocks) {
  std::mt19937 random(6);
  const Mesh bar = testing::box_mesh(60, 3, 3, 1), probe = testing::box_mesh(2, 2, 2, 1);
  BlockTree B = tree_of(bar, bar.X), P = tree_of(probe, probe.X);
  ASSERT_GT(B.num_tet_blocks(), 3 * 16);
  ASSERT_GT(B.num_face_blocks(), 16);
  for (int k = 0; k < 12; ++k) {
    const Eigen::Vector3d way(7 * k, -5 * k, 3 * k);  // of the bar
    const Eigen::Vector3d place(5 * k + 0.5, 0.5, 0.5);
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(0.5 * k, Eigen::Vector3d(1, 2, -1).normalized()).matrix();
    const Eigen::Matrix3Xd x = (R * testing::jittered(bar.X, 0.2, random)).colwise() + way;
    const Eigen::Matrix3Xd y = (R * (probe.X.colwise() + place)).colwise() + way;
    B.update(x, 0.1);
    P.update(y, 0.1);
    const auto rule = NarrowTest::SeparatingAxes;
    const std::vector<Penetration> expected = by_rule(probe, y, bar, x, 0.1, rule);
    EXPECT_GT(expected.size(), 20u);
    EXPECT_EQ(faces_in(P, B).pairs, expected) << k;
    EXPECT_EQ(faces_in(B, P).pairs, by_rule(bar, x, probe, y, 0.1, rule)) << k;
  }
}

// More blocks of faces than are tested against a block of tetrahedra in one go.
TEST(BlockTree, AFewLargeElementsMeetThousandsOfFaces) {
  std::mt19937 random(7);
  const Mesh large = testing::box_mesh(1, 1, 1, 3), fine = testing::box_mesh(24, 24, 24, 0.1);
  const BlockTree L = tree_of(large, large.X);
  const Eigen::Matrix3Xd x = testing::placed(fine.X, Eigen::Vector3d(1.5, 1.4, 1.6), random);
  const BlockTree F = tree_of(fine, x);
  ASSERT_GT(F.num_face_blocks(), 2 * 128);
  EXPECT_EQ(faces_in(F, L).pairs, by_rule(fine, x, large, large.X, 0, NarrowTest::SeparatingAxes));
}

TEST(BlockTree, SortedPairsAreTheSameForEveryInstructionSetAndNumberOfThreads) {
  std::mt19937 random(5);
  const Mesh a = testing::box_mesh(9, 9, 9, 1), b = testing::box_mesh(8, 8, 8, 1);
  const BlockTree A = tree_of(a, testing::jittered(a.X, 0.1, random));
  const BlockTree B = tree_of(b, testing::placed(b.X, Eigen::Vector3d(6, 6, 6), random));
  std::vector<Penetration> first, pairs;
  BlockQueryCounts counts;
  SortScratch sort_scratch;
  for (const int threads : {1, 4}) {
    BlockQueryScratch scratch(std::make_shared<ThreadPool>(threads));
    for (const InstructionSet set : testing::instruction_sets()) {
      faces_in_body(A, B, pairs, counts, scratch, {NarrowTest::SeparatingAxes, set});
      sort_pairs(pairs, A, B, sort_scratch);
      EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
      if (first.empty()) first = pairs;
      EXPECT_EQ(pairs, first);
    }
  }
  EXPECT_GT(first.size(), 500u);
}

TEST(BlockTree, RefusesASurfaceOfAnotherMesh) {
  const Mesh mesh = testing::box_mesh(2, 2, 2, 1);
  for (const int node : {-1, static_cast<int>(mesh.X.cols())}) {
    Surface wrong = mesh.surface;
    wrong.faces(1, 3) = node;
    EXPECT_THROW(BlockTree(mesh.tets, wrong, mesh.X), std::invalid_argument);
  }
  // A node that is there but belongs to no tetrahedron.
  Eigen::Matrix3Xd X(3, mesh.X.cols() + 1);
  X << mesh.X, Eigen::Vector3d(1, 1, 1);
  Surface wrong = mesh.surface;
  wrong.faces(1, 3) = static_cast<int>(mesh.X.cols());
  EXPECT_THROW(BlockTree(mesh.tets, wrong, X), std::invalid_argument);
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

}  // namespace articular::collision::block_tree_test
