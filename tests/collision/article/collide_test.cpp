// Equality with brute force: two bodies, one with itself, any size, order, root and mapping.
#include "collision/article/collide.hpp"

#include <gtest/gtest.h>

#include <set>

#include "collision/article/self_intersection.hpp"
#include "tests/collision/support/meshes.hpp"
#include "tests/collision/support/oracles.hpp"

namespace articular::collision::testing::collide_test {

/// One way to build a tree, at one size of element.
struct Setting {
  Mapping mapping;
  bool fixed_root;
  double edge;   // of an element [m]
  double ratio;  // n of Eq. 1.5.6
};

void PrintTo(const Setting& s, std::ostream* out) {
  *out << (s.mapping == Mapping::Direct ? "direct" : "sorted")
       << (s.fixed_root ? ", fixed root" : ", refitted root") << ", edge " << s.edge << " m, n "
       << s.ratio;
}

std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (Mapping mapping : {Mapping::Direct, Mapping::CoordinateSorting})
    for (bool fixed_root : {false, true})
      for (double edge : {1e-5, 1e-3, 1.0, 1e3}) all.push_back({mapping, fixed_root, edge, 1.0});
  for (double ratio : {0.4, 2.0, 4.0, 1000.0}) all.push_back({Mapping::Direct, false, 1e-3, ratio});
  return all;
}

BucketTree make_tree(const Mesh& mesh, const Setting& setting) {
  BucketTreeOptions options;
  options.bucket_ratio = setting.ratio;
  options.mapping = setting.mapping;
  if (setting.fixed_root) {
    Aabb root;
    root.include(Eigen::Vector3d::Constant(-12 * setting.edge));
    root.include(Eigen::Vector3d::Constant(12 * setting.edge));
    options.fixed_root = root;
  }
  return BucketTree(mesh.tets, mesh.surface, mesh.X, options);
}

class CollideSettings : public ::testing::TestWithParam<Setting> {};

INSTANTIATE_TEST_SUITE_P(Collide, CollideSettings, ::testing::ValuesIn(settings()));

TEST_P(CollideSettings, TwoMovingBodiesGiveThePairsOfBruteForce) {
  const Setting& setting = GetParam();
  std::mt19937 random(1);
  const Mesh a = shuffled(box_mesh(5, 4, 3, setting.edge), random);
  const Mesh b = shuffled(box_mesh(6, 3, 3, 0.7 * setting.edge), random);
  BucketTree tree_a = make_tree(a, setting), tree_b = make_tree(b, setting);
  std::size_t num_pairs = 0;
  for (int step = 0; step < 8; ++step) {
    SCOPED_TRACE(step);
    const Eigen::Matrix3Xd x_a = jittered(placed(a.X, random_vector(random, setting.edge), random),
                                          0.2 * setting.edge, random);
    const Eigen::Matrix3Xd x_b = jittered(
        placed(b.X, random_vector(random, 2.5 * setting.edge), random), 0.2 * setting.edge, random);
    tree_a.update(x_a);
    tree_b.update(x_b);
    const Pairs expected = brute_force(a.at(x_a), b.at(x_b));
    EXPECT_EQ(query(tree_a, tree_b), expected);
    num_pairs += expected.a_in_b.size() + expected.b_in_a.size();
  }
  EXPECT_GT(num_pairs, 1000u);
}

TEST_P(CollideSettings, ABodyWithItselfGivesThePairsOfBruteForce) {
  const Setting& setting = GetParam();
  std::mt19937 random(2);
  const Mesh bar = shuffled(box_mesh(24, 3, 2, setting.edge), random);
  BucketTree tree = make_tree(bar, setting);
  std::size_t num_pairs = 0;
  for (double angle : {0.6, -0.2, -0.4, 0.0, -0.6}) {
    SCOPED_TRACE(angle);
    const Eigen::Matrix3Xd x = jittered(bend_to_v(bar, angle), 0.05 * setting.edge, random);
    tree.update(x);
    const std::vector<Penetration> expected = brute_force_self_intersections(bar.at(x));
    EXPECT_EQ(query_self(tree), expected);
    num_pairs += expected.size();
  }
  EXPECT_GT(num_pairs, 500u);
}

BucketTree tree_of(const Mesh& mesh) { return BucketTree(mesh.tets, mesh.surface, mesh.X); }

TEST(Collide, Listing_1_5_10_ABodyInsideAnotherIsFoundThoughTheSurfacesAreApart) {
  const Mesh large = box_mesh(9, 9, 9, 1e-3), small = box_mesh(2, 2, 2, 0.5e-3);
  BucketTree outer = tree_of(large), inner = tree_of(small);
  outer.update(large.X);
  inner.update(small.X.array() + 4.1e-3);
  const Pairs pairs = query(inner, outer);
  EXPECT_EQ(pairs, brute_force(small.at(inner.positions()), large.at(large.X)));
  std::set<int> faces;
  for (const Penetration& pair : pairs.a_in_b) faces.insert(pair.face);
  EXPECT_EQ(static_cast<int>(faces.size()), inner.num_faces());
  EXPECT_TRUE(pairs.b_in_a.empty());
}

TEST(Collide, Erratum4_ABodyThatHasLeftItsFixedRootCollidesThere) {
  const Mesh mesh = box_mesh(5, 4, 4, 1e-3);
  BucketTreeOptions options;
  options.fixed_root.emplace();
  options.fixed_root->include(Eigen::Vector3d::Constant(-1e-3));
  options.fixed_root->include(Eigen::Vector3d::Constant(6e-3));
  BucketTree A(mesh.tets, mesh.surface, mesh.X, options), B = tree_of(mesh);
  // Far out, half out, and out because it has grown.
  for (const Eigen::Matrix3Xd& x :
       {Eigen::Matrix3Xd(mesh.X.array() + 0.5), Eigen::Matrix3Xd(mesh.X.array() + 3e-3),
        Eigen::Matrix3Xd(4 * mesh.X)}) {
    A.update(x);
    B.update(x.array() + 0.4e-3);
    const Pairs pairs = query(A, B);
    EXPECT_EQ(pairs, brute_force(mesh.at(x), mesh.at(B.positions())));
    EXPECT_GT(pairs.a_in_b.size(), 50u);
  }
  EXPECT_EQ(A.num_root_refits(), 3);
}

TEST(Collide, Erratum13_EachPairWithOverlappingBoxesIsTestedOnce) {
  std::mt19937 random(60);
  const Mesh a = box_mesh(6, 5, 4, 1e-3), b = box_mesh(5, 5, 5, 1e-3);
  BucketTree A(a.tets, a.surface, a.X,
               {.bucket_ratio = 0.5, .fixed_root = {}, .mapping = Mapping::Direct});
  BucketTree B = tree_of(b);
  A.update(placed(a.X, Eigen::Vector3d::Zero(), random));
  B.update(placed(b.X, Eigen::Vector3d(2e-3, 1e-3, 0), random));
  std::int64_t expected = 0;
  const auto count_boxes = [&](const BucketTree& F, const BucketTree& W) {
    for (int face = 0; face < F.num_faces(); ++face)
      for (int tet = 0; tet < W.num_tets(); ++tet)
        expected += overlap(F.face_box(face), W.tet_box(tet)) ? 1 : 0;
  };
  count_boxes(A, B);
  count_boxes(B, A);
  QueryCounts counts;
  QueryScratch scratch;
  Pairs pairs;
  for (int repeat = 1; repeat <= 3; ++repeat) {  // the lists are cleared before each query
    collide(A, B, pairs.a_in_b, pairs.b_in_a, counts, scratch);
    EXPECT_EQ(counts.narrow_tests, repeat * expected);
    EXPECT_GE(counts.box_tests, counts.narrow_tests);
    EXPECT_EQ(counts.reported,
              repeat * static_cast<std::int64_t>(pairs.a_in_b.size() + pairs.b_in_a.size()));
  }
}

TEST(Collide, EveryPairWithinTheMarginIsReportedAndNoneFarBeyondIt) {
  std::mt19937 random(61);
  const Mesh a = box_mesh(4, 4, 3, 1e-3), b = box_mesh(4, 3, 4, 1.2e-3);
  BucketTree A = tree_of(a), B = tree_of(b);
  std::size_t num_within = 0, num_apart = 0;
  for (double margin : {0.05e-3, 0.4e-3, 2e-3}) {
    const Eigen::Matrix3Xd x_a = placed(a.X, Eigen::Vector3d::Zero(), random);
    const Eigen::Matrix3Xd x_b = placed(b.X, Eigen::Vector3d(4e-3, 1e-3, 0), random);
    A.update(x_a, margin);
    B.update(x_b, margin);
    const Pairs pairs = query(A, B);
    EXPECT_EQ(pairs, brute_force(a.at(x_a), b.at(x_b), margin));
    const std::set<Penetration> reported(pairs.a_in_b.begin(), pairs.a_in_b.end());
    for (int face = 0; face < A.num_faces(); ++face)
      for (int tet = 0; tet < B.num_tets(); ++tet) {
        const double distance = triangle_tetrahedron_distance(
            corners<3>(x_a, a.surface.faces.col(face)), corners<4>(x_b, b.tets.col(tet)));
        if (distance <= (1 - 1e-9) * margin) {
          EXPECT_TRUE(reported.contains({face, tet})) << distance << " m, margin " << margin;
          ++num_within;
          num_apart += distance > 0 ? 1 : 0;
        } else if (distance > 1.01 * margin) {
          EXPECT_FALSE(reported.contains({face, tet})) << distance << " m, margin " << margin;
        }
      }
  }
  EXPECT_GT(num_within, 1000u);
  EXPECT_GT(num_apart, 500u);
}

TEST(Collide, FlatElementsAndCoincidentNodesGiveThePairsOfBruteForce) {
  std::mt19937 random(62);
  const Mesh a = box_mesh(5, 4, 3, 1e-3), b = box_mesh(4, 4, 4, 1e-3);
  BucketTree A = tree_of(a), B = tree_of(b);
  for (int kind = 0; kind < 5; ++kind) {
    SCOPED_TRACE(kind);
    Eigen::Matrix3Xd x = a.X.array() + 1.1e-3, y = b.X;
    if (kind == 0) x.row(2).setConstant(1.5e-3);  // all flat, inside the other
    if (kind == 1) x.rightCols(40) = x.col(3).replicate(1, 40);
    if (kind == 2) x.row(0).setConstant(2e-3), y.row(0).setConstant(2e-3);  // both in one plane
    if (kind == 3) x.setConstant(2.1e-3);                                   // a point
    if (kind == 4) x = a.X, y = b.X;  // the same lattice: all contacts are touching ones
    A.update(x);
    B.update(y);
    const Pairs pairs = query(A, B);
    EXPECT_EQ(pairs, brute_force(a.at(x), b.at(y)));
    EXPECT_FALSE(pairs.a_in_b.empty());
    EXPECT_EQ(query_self(A), brute_force_self_intersections(a.at(x)));
  }
}

TEST(Collide, EnormousAndTinyCoordinatesGiveThePairsOfBruteForce) {
  std::mt19937 random(63);
  const Mesh a = box_mesh(4, 3, 3, 1), b = box_mesh(3, 3, 4, 1);
  BucketTree A = tree_of(a), B = tree_of(b);
  const Eigen::Matrix3Xd x = placed(a.X, Eigen::Vector3d::Zero(), random);
  const Eigen::Matrix3Xd y = placed(b.X, Eigen::Vector3d(1.5, 1, 0), random);
  for (const auto& [scale, offset] :
       {std::pair{1e-200, 0.0}, {1e-9, 1.0}, {1.0, 1e6}, {1e140, 0.0}}) {
    SCOPED_TRACE(scale);
    A.update((scale * x).array() + offset);
    B.update((scale * y).array() + offset);
    const Pairs pairs = query(A, B);
    EXPECT_EQ(pairs, brute_force(a.at(A.positions()), b.at(B.positions())));
    EXPECT_GT(pairs.a_in_b.size(), 20u);
  }
}

TEST(Collide, BodiesApartGiveNothingAndCostNothing) {
  const Mesh mesh = box_mesh(4, 4, 4, 1e-3);
  BucketTree A = tree_of(mesh), B = tree_of(mesh);
  A.update(mesh.X);
  B.update(mesh.X.array() + 5e-3);
  Pairs pairs{{{1, 2}}, {{3, 4}}};
  QueryCounts counts;
  collide(A, B, pairs.a_in_b, pairs.b_in_a, counts);
  EXPECT_EQ(pairs, Pairs());
  EXPECT_EQ(counts.box_tests, 0);
}

TEST(Collide, AMeshWithoutElementsMeetsNothing) {
  const Mesh mesh = box_mesh(2, 2, 2, 1e-3);
  const Eigen::Matrix4Xi no_tets(4, 0);
  const Eigen::Matrix3Xd no_nodes(3, 0);
  for (Mapping mapping : {Mapping::Direct, Mapping::CoordinateSorting}) {
    BucketTree none(no_tets, build_surface(no_tets, 0), no_nodes,
                    {.bucket_ratio = 1, .fixed_root = {}, .mapping = mapping});
    BucketTree some = tree_of(mesh);
    none.update(no_nodes);
    some.update(mesh.X);
    EXPECT_EQ(query(none, some), Pairs());
    EXPECT_EQ(query(some, none), Pairs());
    EXPECT_TRUE(query_self(none).empty());
  }
}

}  // namespace articular::collision::testing::collide_test
