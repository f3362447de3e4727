#include "collision/article/tandem.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/collision/support/meshes.hpp"

namespace articular::collision::testing::tandem_test {

using Place = std::array<std::uint8_t, 3>;
using BucketPairs = std::multiset<std::pair<Place, Place>>;

std::vector<BucketTree::Node> current_buckets(const BucketTree& tree) {
  std::vector<BucketTree::Node> buckets;
  const int n = 1 << (tree.num_levels() - 1);
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const BucketTree::Node node{static_cast<std::uint8_t>(tree.num_levels()),
                                    {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y),
                                     static_cast<std::uint8_t>(z)}};
        if (tree.is_current(node)) buckets.push_back(node);
      }
  return buckets;
}

BucketPairs all_pairs(const BucketTree& A, const BucketTree& B) {
  BucketPairs pairs;
  for (const BucketTree::Node a : current_buckets(A))
    for (const BucketTree::Node b : current_buckets(B))
      if ((A.has_surface(a) || B.has_surface(b)) && overlap(A.box(a), B.box(b)))
        pairs.insert({a.place, b.place});
  return pairs;
}

BucketPairs traversed_pairs(const BucketTree& A, const BucketTree& B,
                            std::vector<NodePair>& stack) {
  BucketPairs pairs;
  tandem_traversal(A, B, stack, [&](BucketTree::Node a, BucketTree::Node b) {
    EXPECT_TRUE(A.is_bucket(a) && B.is_bucket(b));
    pairs.insert({a.place, b.place});
  });
  return pairs;
}

BucketTree tree_of(const Mesh& mesh, double ratio) {
  return BucketTree(mesh.tets, mesh.surface, mesh.X,
                    {.bucket_ratio = ratio, .fixed_root = {}, .mapping = Mapping::Direct});
}

TEST(Tandem, Listing_1_5_8_VisitsEachPairOfOverlappingBucketsWithSurfaceOnce) {
  std::mt19937 random(30);
  const Mesh a = box_mesh(8, 8, 7, 1e-3), b = box_mesh(5, 12, 4, 0.8e-3);
  std::vector<NodePair> stack;
  // Trees of the same depth, of different depth, and of the root alone.
  for (const auto& [ratio_a, ratio_b] :
       {std::pair{1.0, 1.0}, {0.8, 4.0}, {4.0, 0.8}, {1000.0, 1.0}, {1000.0, 1000.0}}) {
    BucketTree A = tree_of(a, ratio_a), B = tree_of(b, ratio_b);
    for (int step = 0; step < 3; ++step) {
      A.update(placed(a.X, random_vector(random, 1e-3), random));
      B.update(placed(b.X, random_vector(random, 3e-3), random));
      const BucketPairs expected = all_pairs(A, B);
      EXPECT_EQ(traversed_pairs(A, B, stack), expected);
      EXPECT_FALSE(expected.empty());
    }
  }
}

TEST(Tandem, Listing_1_5_9_BucketsInsideBothBodiesAreNotVisited) {
  const Mesh a = box_mesh(9, 9, 9, 1e-3);
  BucketTree A = tree_of(a, 1), B = tree_of(a, 1);
  A.update(a.X);
  B.update(a.X.array() + 0.1e-3);
  std::vector<NodePair> stack;
  std::size_t num_overlapping = 0;
  for (const BucketTree::Node i : current_buckets(A))
    for (const BucketTree::Node j : current_buckets(B))
      num_overlapping += overlap(A.box(i), B.box(j)) ? 1 : 0;
  EXPECT_LT(traversed_pairs(A, B, stack).size(), num_overlapping);
}

TEST(Tandem, Erratum12_NowIsPerTree) {
  const Mesh mesh = box_mesh(4, 4, 4, 1e-3);
  BucketTree A = tree_of(mesh, 1), B = tree_of(mesh, 1);
  A.update(mesh.X);
  for (int step = 0; step < 5; ++step) B.update(mesh.X.array() + 0.5e-3);
  EXPECT_FALSE(query(A, B).a_in_b.empty());
  EXPECT_EQ(query(A, B), brute_force(mesh.at(A.positions()), mesh.at(B.positions())));
}

TEST(Tandem, Erratum12_TheStackStaysSmall) {
  const Mesh mesh = box_mesh(20, 20, 20, 1e-3);
  BucketTree A = tree_of(mesh, 1), B = tree_of(mesh, 1);
  A.update(mesh.X);
  B.update(mesh.X.array() + 0.3e-3);
  std::vector<NodePair> stack;
  std::size_t most = 0, num_visited = 0;
  tandem_traversal(A, B, stack, [&](BucketTree::Node, BucketTree::Node) {
    most = std::max(most, stack.size());
    ++num_visited;
  });
  EXPECT_LE(most, static_cast<std::size_t>(7 * (A.num_levels() + B.num_levels())));
  EXPECT_GT(num_visited, 20 * most);
}

TEST(Tandem, Erratum12_ExchangingTheTreesExchangesTheAnswers) {
  std::mt19937 random(31);
  const Mesh a = box_mesh(8, 4, 4, 1e-3), b = box_mesh(3, 3, 3, 2e-3);
  BucketTree A = tree_of(a, 0.7), B = tree_of(b, 3);
  A.update(placed(a.X, Eigen::Vector3d::Zero(), random));
  B.update(placed(b.X, Eigen::Vector3d(2e-3, 0, 1e-3), random));
  const Pairs forth = query(A, B), back = query(B, A);
  EXPECT_FALSE(forth.a_in_b.empty());
  EXPECT_NE(forth.a_in_b.size(), forth.b_in_a.size());
  EXPECT_EQ(forth.a_in_b, back.b_in_a);
  EXPECT_EQ(forth.b_in_a, back.a_in_b);
}

TEST(Tandem, ATreeThatWasNeverUpdatedIsEmpty) {
  const Mesh mesh = box_mesh(2, 2, 2, 1e-3);
  BucketTree A = tree_of(mesh, 1), B = tree_of(mesh, 1);
  A.update(mesh.X);
  EXPECT_EQ(query(A, B), Pairs());
  EXPECT_EQ(query(B, A), Pairs());
  EXPECT_TRUE(query_self(B).empty());
}

}  // namespace articular::collision::testing::tandem_test
