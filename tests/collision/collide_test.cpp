// Equality with brute force: two bodies, one with itself, any size, order, root and mapping.
#include "collision/collide.hpp"

#include <gtest/gtest.h>

#include "collision/self_intersection.hpp"
#include "tests/collision/meshes.hpp"

namespace articular::collision::testing {
namespace {

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

}  // namespace
}  // namespace articular::collision::testing
