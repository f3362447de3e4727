#include "collision/article/self_intersection.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/collision/support/meshes.hpp"

namespace articular::collision::testing::self_intersection_test {

BucketTree tree_of(const Mesh& mesh) {
  return BucketTree(mesh.tets, mesh.surface, mesh.X,
                    {.bucket_ratio = 1, .fixed_root = {}, .mapping = Mapping::Direct});
}

/// Pairs by their nodes, which do not change when elements are renumbered.
std::set<std::pair<std::set<int>, std::set<int>>> by_nodes(const Mesh& mesh,
                                                           const std::vector<Penetration>& pairs) {
  std::set<std::pair<std::set<int>, std::set<int>>> result;
  for (const Penetration& pair : pairs) {
    const Eigen::Vector3i face = mesh.surface.faces.col(pair.face);
    const Eigen::Vector4i tet = mesh.tets.col(pair.tetrahedron);
    result.insert({{face.begin(), face.end()}, {tet.begin(), tet.end()}});
  }
  return result;
}

TEST(SelfIntersection, Listing_1_5_3_WhileMappingAndAfterwardsGiveTheSamePairs) {
  std::mt19937 random(40);
  const Mesh bar = shuffled(box_mesh(20, 3, 3, 1e-3), random);
  BucketTree during = tree_of(bar), after = tree_of(bar);
  QueryScratch scratch;
  for (double angle : {0.5, -0.2, -0.4, -0.3}) {
    const Eigen::Matrix3Xd x = jittered(bend_to_v(bar, angle), 0.05e-3, random);
    std::vector<Penetration> pairs, pairs_after;
    QueryCounts counts, counts_after;
    update_and_find_self_intersections(during, x, 0.02e-3, pairs, counts, scratch);
    after.update(x, 0.02e-3);
    self_intersections(after, pairs_after, counts_after);
    EXPECT_EQ(pairs, pairs_after);
    EXPECT_EQ(pairs, brute_force_self_intersections(bar.at(x), 0.02e-3));
    EXPECT_EQ(counts.box_tests, counts_after.box_tests);
    EXPECT_EQ(counts.narrow_tests, counts_after.narrow_tests);
  }
  EXPECT_EQ(during.num_updates(), 4);
}

TEST(SelfIntersection, Erratum7_TheOrderOfTheElementsDoesNotMatter) {
  std::mt19937 random(41);
  const Mesh bar = box_mesh(20, 3, 3, 1e-3);
  const Eigen::Matrix3Xd x = jittered(bend_to_v(bar, -0.3), 0.05e-3, random);
  BucketTree tree = tree_of(bar);
  tree.update(x);
  const auto expected = by_nodes(bar, query_self(tree));
  EXPECT_GT(expected.size(), 100u);
  for (int i = 0; i < 4; ++i) {
    const Mesh renumbered = shuffled(bar, random);
    BucketTree other = tree_of(renumbered);
    other.update(x);
    EXPECT_EQ(by_nodes(renumbered, query_self(other)), expected);
  }
}

// The listing as printed tests the faces of the new tetrahedron only.
TEST(SelfIntersection, Erratum7_OneDirectionAloneLosesPairs) {
  std::mt19937 random(43);
  const Mesh bar = shuffled(box_mesh(20, 3, 3, 1e-3), random);
  const Eigen::Matrix3Xd x = bend_to_v(bar, -0.3);
  BucketTree tree = tree_of(bar);
  std::set<Penetration> as_printed;
  tree.update(x, 0, [&](int Q, std::span<const int> earlier) {
    for (int W : earlier)
      for (int face : tree.faces_of(Q))
        if (!have_common_node(bar.surface.faces, face, bar.tets, W) &&
            gjk_overlap(corners<3>(x, bar.surface.faces.col(face)), corners<4>(x, bar.tets.col(W))))
          as_printed.insert({face, W});
  });
  const std::vector<Penetration> all = query_self(tree);
  EXPECT_LT(as_printed.size(), 0.7 * static_cast<double>(all.size()));
  EXPECT_GT(as_printed.size(), 0.3 * static_cast<double>(all.size()));
}

TEST(SelfIntersection, Erratum8_ElementsThatMeetAtACommonNodeAreNoPairs) {
  std::mt19937 random(42);
  const Mesh cube = box_mesh(5, 5, 5, 1e-3);
  BucketTree tree = tree_of(cube);
  tree.update(jittered(cube.X, 0.1e-3, random));
  EXPECT_TRUE(query_self(tree).empty());
}

TEST(SelfIntersection, Erratum8_ElementsWithoutACommonNodeArePairsHoweverNearInTheMesh) {
  Mesh bar = box_mesh(3, 1, 1, 1e-3);
  Eigen::Matrix3Xd x = bar.X;
  for (Eigen::Index a = 0; a < x.cols(); ++a)  // the last cube folded back into the first
    if (bar.X(0, a) > 2.5e-3) x(0, a) = 0.5e-3;
  BucketTree tree = tree_of(bar);
  tree.update(x);
  const std::vector<Penetration> pairs = query_self(tree);
  EXPECT_FALSE(pairs.empty());
  EXPECT_EQ(pairs, brute_force_self_intersections(bar.at(x)));
}

}  // namespace articular::collision::testing::self_intersection_test
