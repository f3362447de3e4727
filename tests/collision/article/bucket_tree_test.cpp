#include "collision/article/bucket_tree.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "tests/collision/support/meshes.hpp"

namespace articular::collision::testing::bucket_tree_test {

/// All nodes of a level.
std::vector<BucketTree::Node> nodes_at(int level) {
  std::vector<BucketTree::Node> nodes = {BucketTree::root_node()};
  for (int l = 1; l < level; ++l) {
    std::vector<BucketTree::Node> children;
    for (const BucketTree::Node node : nodes)
      for (int octant = 0; octant < 8; ++octant)
        children.push_back(BucketTree::child(node, octant));
    nodes = children;
  }
  return nodes;
}

std::vector<BucketTree::Node> buckets_of(const BucketTree& tree) {
  return nodes_at(tree.num_levels());
}

/// Contents of every current bucket, without the order.
std::map<std::array<std::uint8_t, 3>, std::multiset<int>> contents_of(const BucketTree& tree) {
  std::map<std::array<std::uint8_t, 3>, std::multiset<int>> contents;
  for (const BucketTree::Node bucket : buckets_of(tree))
    if (tree.is_current(bucket)) {
      const auto tets = tree.tets_in(bucket);
      contents[bucket.place] = {tets.begin(), tets.end()};
    }
  return contents;
}

double entries_per_tet(const BucketTree& tree) {
  std::size_t entries = 0;
  for (int i = 0; i < tree.num_non_empty_buckets(); ++i) entries += tree.non_empty_bucket(i).size();
  return static_cast<double>(entries) / tree.num_tets();
}

BucketTree tree_of(const Mesh& mesh, const BucketTreeOptions& options = {}) {
  return BucketTree(mesh.tets, mesh.surface, mesh.X, options);
}

template <class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

// ---- Level choice

TEST(BucketTree, Equation_1_5_6_LevelsDoubleTheBucketsUntilTheyAreNDiameters) {
  const double r = 0.5;  // diameter 1
  EXPECT_EQ(choose_num_levels(0.9, r, 1), 1);
  EXPECT_EQ(choose_num_levels(1.0, r, 1), 1);
  EXPECT_EQ(choose_num_levels(1.99, r, 1), 1);
  EXPECT_EQ(choose_num_levels(2.0, r, 1), 2);
  EXPECT_EQ(choose_num_levels(16.0, r, 1), 5);
  EXPECT_EQ(choose_num_levels(16.0, r, 2), 4);
  EXPECT_EQ(choose_num_levels(1e9, r, 1), BucketTree::kMaxLevels);
  EXPECT_EQ(choose_num_levels(1, 0, 1), BucketTree::kMaxLevels);
  EXPECT_EQ(choose_num_levels(0, 0, 1), 1);
}

TEST(BucketTree, Equation_1_5_6_DoesNotDependOnTheUnitOfLength) {
  for (double edge : {1e-5, 1e-3, 1.0, 1e3})
    EXPECT_EQ(tree_of(box_mesh(16, 2, 2, edge)).num_levels(), 4) << edge;
}

TEST(BucketTree, Equation_1_5_5_TheMeanRadiusIsThatOfTheMeanVolume) {
  const Mesh mesh = box_mesh(2, 2, 2, 3);  // each tetrahedron has 27/6
  const double r = mean_tetrahedron_radius(mesh.tets, mesh.X);
  EXPECT_NEAR(4 * std::numbers::pi / 3 * r * r * r, 27.0 / 6, 1e-12);
}

TEST(BucketTree, Erratum1_AnInvertedOrFlatRestElementIsNamed) {
  Mesh mesh = box_mesh(2, 1, 1, 1e-3);
  std::swap(mesh.tets(0, 5), mesh.tets(1, 5));
  EXPECT_EQ(message_of([&] { tree_of(mesh); }).find("tetrahedron 5 is inverted or flat at rest"),
            0u);
  Mesh flat = box_mesh(2, 1, 1, 1e-3);
  flat.X.row(2).setZero();
  EXPECT_EQ(message_of([&] { tree_of(flat); }).find("tetrahedron 0 is inverted or flat at rest"),
            0u);
}

TEST(BucketTree, Erratum2_BucketsOfAFlatBodyAreCubesWithFewElements) {
  const Mesh plate = box_mesh(40, 40, 1, 1e-3);
  BucketTree tree = tree_of(plate);
  tree.update(plate.X);
  const Eigen::Vector3d size = tree.root().max - tree.root().min;
  EXPECT_NEAR(size.minCoeff(), size.maxCoeff(), 1e-15);
  EXPECT_LT(entries_per_tet(tree), 5);
}

TEST(BucketTree, Erratum2_BucketsOfAFoldedBodyStayAsLargeAsItsElements) {
  const Mesh bar = box_mesh(64, 2, 2, 1e-3);
  BucketTree tree = tree_of(bar);
  const double diameter = 2 * mean_tetrahedron_radius(bar.tets, bar.X);
  for (double angle : {std::numbers::pi - 0.01, 0.05}) {
    tree.update(bend_to_v(bar, angle));
    const double bucket_edge = tree.root().longest_edge() / (1 << (tree.num_levels() - 1));
    EXPECT_GE(bucket_edge, BucketTreeOptions().bucket_ratio * diameter * (1 - 1e-12));
  }
}

// ---- Mapping

TEST(BucketTree, Erratum4_APointOnTheUpperBoundaryIsInTheLastBucket) {
  const Mesh cube = box_mesh(4, 4, 4, 1);
  BucketTree tree =
      tree_of(cube, {.bucket_ratio = 1, .fixed_root = {}, .mapping = Mapping::Direct});
  ASSERT_GT(tree.num_levels(), 1);
  tree.update(cube.X);
  const std::uint8_t last = static_cast<std::uint8_t>((1 << (tree.num_levels() - 1)) - 1);
  const BucketTree::Node corner{static_cast<std::uint8_t>(tree.num_levels()), {last, last, last}};
  EXPECT_TRUE(tree.is_current(corner));
}

TEST(BucketTree, Erratum4_AMeshThatLeavesItsFixedRootIsFollowedAndCounted) {
  const Mesh cube = box_mesh(4, 4, 4, 1e-3);
  BucketTreeOptions options;
  options.fixed_root.emplace();
  options.fixed_root->include(Eigen::Vector3d::Zero());
  options.fixed_root->include(Eigen::Vector3d(8e-3, 8e-3, 8e-3));
  BucketTree tree = tree_of(cube, options);
  const auto all_boxes_are_in_their_buckets = [&] {
    for (const BucketTree::Node bucket : buckets_of(tree))
      if (tree.is_current(bucket))
        for (int tet : tree.tets_in(bucket))
          if (!overlap(tree.box(bucket), tree.tet_box(tet))) return false;
    return contains(tree.root(), tree.bounds());
  };
  tree.update(cube.X);
  EXPECT_EQ(tree.num_root_refits(), 0);
  EXPECT_EQ(tree.root().min, options.fixed_root->min);
  EXPECT_TRUE(all_boxes_are_in_their_buckets());
  tree.update(cube.X.array() + 6e-3);  // partly out
  EXPECT_EQ(tree.num_root_refits(), 1);
  EXPECT_NEAR(tree.root().longest_edge(), 8e-3, 1e-15);
  EXPECT_TRUE(all_boxes_are_in_their_buckets());
  tree.update(5 * cube.X);  // larger than the root
  EXPECT_EQ(tree.num_root_refits(), 2);
  EXPECT_TRUE(all_boxes_are_in_their_buckets());
  tree.update(cube.X);  // back
  EXPECT_EQ(tree.num_root_refits(), 2);
  EXPECT_EQ(tree.root().min, options.fixed_root->min);
}

TEST(BucketTree, Erratum5_EveryBucketThatAnElementsBoxReachesHasTheElement) {
  std::mt19937 random(11);
  const Mesh mesh = box_mesh(6, 5, 4, 1e-3);
  int num_inside_one = 0;
  for (const auto& [mapping, ratio] : {std::pair{Mapping::Direct, 0.7},
                                       {Mapping::Direct, 2.0},
                                       {Mapping::CoordinateSorting, 0.7},
                                       {Mapping::CoordinateSorting, 2.0}}) {
    BucketTree tree = tree_of(mesh, {.bucket_ratio = ratio, .fixed_root = {}, .mapping = mapping});
    tree.update(jittered(mesh.X, 0.3e-3, random), 0.1e-3);
    for (int Q = 0; Q < tree.num_tets(); ++Q) {
      int num_buckets = 0;
      for (const BucketTree::Node bucket : buckets_of(tree)) {
        const std::span<const int> tets =
            tree.is_current(bucket) ? tree.tets_in(bucket) : std::span<const int>();
        const auto count = std::count(tets.begin(), tets.end(), Q);
        EXPECT_EQ(count, overlap(tree.box(bucket), tree.tet_box(Q)) ? 1 : 0);
        num_buckets += static_cast<int>(count);
      }
      num_inside_one += num_buckets == 1 ? 1 : 0;
    }
  }
  EXPECT_GT(num_inside_one, 0);  // Listing 1.5.2 as printed adds those nowhere
}

TEST(BucketTree, Erratum6_Listing_1_5_4_NothingOfEarlierUpdatesIsLeft) {
  std::mt19937 random(12);
  const Mesh mesh = box_mesh(6, 4, 3, 1e-3);
  BucketTreeOptions options;
  options.bucket_ratio = 1;
  options.fixed_root.emplace();
  options.fixed_root->include(Eigen::Vector3d::Constant(-8e-3));
  options.fixed_root->include(Eigen::Vector3d::Constant(8e-3));
  BucketTree tree = tree_of(mesh, options);
  for (int step = 0; step < 6; ++step) {
    const Eigen::Matrix3Xd x = placed(mesh.X, random_vector(random, 3e-3), random);
    tree.update(x);
    BucketTree fresh = tree_of(mesh, options);
    fresh.update(x);
    EXPECT_EQ(contents_of(tree), contents_of(fresh));
    for (const BucketTree::Node bucket : buckets_of(tree))
      if (tree.is_current(bucket)) {
        EXPECT_EQ(tree.has_surface(bucket), fresh.has_surface(bucket));
      }
    EXPECT_EQ(static_cast<std::size_t>(tree.num_non_empty_buckets()), contents_of(tree).size());
  }
  EXPECT_EQ(tree.num_updates(), 6);
}

// ---- Flags

TEST(BucketTree, Erratum9_Listing_1_5_5_ANodeKnowsWhetherThereIsAnythingAndAnySurfaceBelow) {
  std::mt19937 random(13);
  const Mesh mesh = box_mesh(9, 9, 9, 1e-3);
  BucketTree tree =
      tree_of(mesh, {.bucket_ratio = 0.9, .fixed_root = {}, .mapping = Mapping::Direct});
  ASSERT_GE(tree.num_levels(), 4);
  int num_interior = 0;
  for (int step = 0; step < 4; ++step) {
    tree.update(step == 0 ? mesh.X : placed(mesh.X, random_vector(random, 1e-3), random));
    EXPECT_TRUE(tree.is_current(BucketTree::root_node()));
    EXPECT_TRUE(tree.has_surface(BucketTree::root_node()));
    for (const BucketTree::Node bucket : buckets_of(tree))
      if (tree.is_current(bucket)) {
        bool surface = false;
        for (int tet : tree.tets_in(bucket)) surface = surface || !tree.faces_of(tet).empty();
        EXPECT_EQ(tree.has_surface(bucket), surface);
        num_interior += surface ? 0 : 1;
      }
    for (int level = 1; level < tree.num_levels(); ++level)
      for (const BucketTree::Node node : nodes_at(level)) {
        bool current = false, surface = false;
        for (int octant = 0; octant < 8; ++octant) {
          const BucketTree::Node c = BucketTree::child(node, octant);
          current = current || tree.is_current(c);
          surface = surface || (tree.is_current(c) && tree.has_surface(c));
        }
        EXPECT_EQ(tree.is_current(node), current);
        if (current) {
          EXPECT_EQ(tree.has_surface(node), surface);
        }
      }
  }
  EXPECT_GT(num_interior, 0);
}

TEST(BucketTree, Erratum10_Listing_1_5_6_TheLastBucketEndsWhereTheRootEnds) {
  const Mesh bar = box_mesh(100, 1, 1, 0.1);
  BucketTree tree = tree_of(bar, {.bucket_ratio = 1, .fixed_root = {}, .mapping = Mapping::Direct});
  tree.update(bar.X.array() + 0.123);
  const int last = (1 << (tree.num_levels() - 1)) - 1;
  ASSERT_EQ(last, 63);
  const std::uint8_t place = static_cast<std::uint8_t>(last);
  const Aabb box = tree.box({static_cast<std::uint8_t>(tree.num_levels()), {place, place, place}});
  const double step = tree.root().longest_edge() / 64;
  // box() adds some ε of the root's coordinates for the round-off of the mapping.
  EXPECT_NEAR((box.max - tree.root().max).norm(), 0, 1e-12);
  EXPECT_NEAR((box.max - box.min).maxCoeff(), step, 1e-12);
}

// ---- Updates

TEST(BucketTree, APositionThatIsNotFiniteIsNamedAndChangesNothing) {
  const Mesh mesh = box_mesh(3, 2, 2, 1e-3);
  for (Mapping mapping : {Mapping::Direct, Mapping::CoordinateSorting}) {
    BucketTree tree = tree_of(mesh, {.bucket_ratio = 1, .fixed_root = {}, .mapping = mapping});
    tree.update(mesh.X);
    const auto before = contents_of(tree);
    for (double bad : {std::numeric_limits<double>::quiet_NaN(),
                       std::numeric_limits<double>::infinity(), -1e300}) {
      Eigen::Matrix3Xd x = mesh.X;
      x(1, 7) = bad;
      const std::string message = message_of([&] { tree.update(x); });
      EXPECT_EQ(message.find("position of node 7 is (0.003, "), 0u) << message;
      EXPECT_EQ(tree.num_updates(), 1);
      EXPECT_EQ(contents_of(tree), before);
      EXPECT_EQ(tree.positions(), mesh.X);
    }
  }
}

TEST(BucketTree, BadArgumentsAreRefused) {
  const Mesh mesh = box_mesh(3, 2, 2, 1e-3);
  BucketTree tree = tree_of(mesh);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(tree.update(mesh.X.leftCols(5)), std::invalid_argument);
  EXPECT_THROW(tree.update(mesh.X, -1e-3), std::invalid_argument);
  EXPECT_THROW(tree.update(mesh.X, nan), std::invalid_argument);
  BucketTreeOptions options;
  for (double ratio : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    options.bucket_ratio = ratio;
    EXPECT_THROW(tree_of(mesh, options), std::invalid_argument) << ratio;
  }
  options = {};
  options.fixed_root.emplace();  // empty
  EXPECT_THROW(tree_of(mesh, options), std::invalid_argument);
  options.fixed_root->include(Eigen::Vector3d(1, 2, 3));  // a point
  EXPECT_THROW(tree_of(mesh, options), std::invalid_argument);
  EXPECT_THROW(BucketTree(mesh.tets.leftCols(3), mesh.surface, mesh.X), std::invalid_argument);
  EXPECT_THROW(BucketTree(mesh.tets, mesh.surface, mesh.X.leftCols(3)), std::invalid_argument);
  Mesh bad = mesh;
  bad.X(2, 3) = nan;
  EXPECT_EQ(message_of([&] { tree_of(bad); }).find("rest position of node 3 is"), 0u);
}

TEST(BucketTree, ACopyIsIndependent) {
  const Mesh mesh = box_mesh(4, 3, 3, 1e-3);
  BucketTree tree = tree_of(mesh);
  tree.update(mesh.X);
  const auto before = contents_of(tree);
  BucketTree copy = tree;
  copy.update(2 * mesh.X);
  EXPECT_EQ(contents_of(tree), before);
  EXPECT_EQ(tree.positions(), mesh.X);
  EXPECT_EQ(tree.num_updates(), 1);
  EXPECT_EQ(copy.num_updates(), 2);
}

TEST(BucketTree, AMeshShrunkToAPointOrSpreadOverSixteenDecadesIsMapped) {
  std::mt19937 random(14);
  const Mesh mesh = box_mesh(4, 3, 3, 1);
  for (Mapping mapping : {Mapping::Direct, Mapping::CoordinateSorting}) {
    BucketTree tree = tree_of(mesh, {.bucket_ratio = 1, .fixed_root = {}, .mapping = mapping});
    const std::vector<Eigen::Matrix3Xd> shapes = {0 * mesh.X, 1e-300 * mesh.X, 1e140 * mesh.X,
                                                  (1e-9 * mesh.X).array() + 1e9,
                                                  (0 * mesh.X).array() + 1e140};
    for (const Eigen::Matrix3Xd& x : shapes) {
      tree.update(x);
      EXPECT_TRUE(tree.is_current(BucketTree::root_node()));
      EXPECT_GE(entries_per_tet(tree), 1);
    }
    Eigen::Matrix3Xd one_far = mesh.X;
    one_far.col(0).setConstant(-1e16);
    tree.update(one_far);
    EXPECT_GE(entries_per_tet(tree), 1);
  }
}

TEST(BucketTree, NodesWithoutAnElementDoNotEnlargeTheRoot) {
  Mesh mesh = box_mesh(4, 4, 4, 1e-3);
  mesh.X.conservativeResize(3, mesh.X.cols() + 1);
  mesh.X.rightCols(1).setConstant(1e3);
  BucketTree tree = tree_of(mesh);
  tree.update(mesh.X);
  EXPECT_LT(tree.root().longest_edge(), 1e-2);
}

}  // namespace articular::collision::testing::bucket_tree_test
