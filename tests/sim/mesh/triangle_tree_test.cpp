// Distances from a surface, against a loop over all of its triangles.
#include "sim/mesh/triangle_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "sim/mesh/triangle_distance.hpp"

namespace articular::sim::triangle_tree_test {

struct TriangleCloud {
  Positions X;
  Triangles triangles;

  double squared_distance_from(const Vec3& x) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& t : triangles.colwise())
      least = std::min(least, squared_distance(x, X.col(t[0]), X.col(t[1]), X.col(t[2])));
    return least;
  }
};

/// Small triangles all over a long box, some without area, some twice.
TriangleCloud triangle_cloud(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  TriangleCloud cloud{Positions(3, 3 * count), Triangles(3, count)};
  for (int t = 0; t < count; ++t) {
    const Vec3 at = any().cwiseProduct(Vec3(1, 1, 10));
    for (int k = 0; k < 3; ++k) {
      cloud.X.col(3 * t + k) = at + 0.2 * any();
      cloud.triangles(k, t) = 3 * t + k;
    }
    if (t % 7 == 0) cloud.X.col(3 * t + 1) = cloud.X.col(3 * t);
    if (t % 11 == 1) cloud.X.middleCols<3>(3 * t) = cloud.X.middleCols<3>(3 * t - 3);
  }
  return cloud;
}

TEST(TriangleTree, HasTheDistancesOfALoopOverAllTrianglesToTheLastBit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const int count : {1, 3, 5, 400}) {
    const TriangleCloud cloud = triangle_cloud(count, random);
    const TriangleTree tree(cloud.X, cloud.triangles);
    int within = 0, beyond = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3 x = 2 * Vec3(unit(random), unit(random), 5 * unit(random));
      const double distance = std::sqrt(cloud.squared_distance_from(x));
      ASSERT_EQ(tree.distance(x), distance);
      ASSERT_TRUE(tree.is_within(x, distance * (1 + 1e-12)));
      ASSERT_FALSE(tree.is_within(x, distance * (1 - 1e-12)));
      ++(tree.is_within(x, 0.5) ? within : beyond);
    }
    if (count == 400) {
      EXPECT_GT(within, 50);
      EXPECT_GT(beyond, 50);
    }
  }
}

TEST(TriangleTree, ACornerLiesAtNoDistanceButRoundOff) {
  std::mt19937 random(3);
  const TriangleCloud cloud = triangle_cloud(50, random);
  const TriangleTree tree(cloud.X, cloud.triangles);
  for (const auto& corner : cloud.X.colwise()) EXPECT_TRUE(tree.is_within(corner, 1e-15));
}

TEST(TriangleTree, FindsEveryTriangleThatASegmentMeetsAndFewBesides) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> unit(-1, 1);
  const TriangleCloud cloud = triangle_cloud(400, random);
  const TriangleTree tree(cloud.X, cloud.triangles);
  const auto any = [&]() -> Vec3 { return 2 * Vec3(unit(random), unit(random), 5 * unit(random)); };
  const auto volume = [](const Vec3& x, const Vec3& y, const Vec3& z) { return x.dot(y.cross(z)); };
  int met = 0;
  std::size_t num_found = 0;
  std::vector<int> found;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 p = any();
    Vec3 q = any();
    if (k % 2 == 1) q.head<2>() = p.head<2>();  // along an edge of the boxes
    const Vec3 d = q - p;
    tree.find(p, q, 0, found);
    num_found += found.size();
    for (int f = 0; f < 400; ++f) {
      const Vec3 a = cloud.X.col(cloud.triangles(0, f)), b = cloud.X.col(cloud.triangles(1, f)),
                 c = cloud.X.col(cloud.triangles(2, f));
      const bool same = (volume(d, a - p, b - p) > 0) == (volume(d, b - p, c - p) > 0) &&
                        (volume(d, b - p, c - p) > 0) == (volume(d, c - p, a - p) > 0);
      const bool between = volume(b - a, c - a, p - a) * volume(b - a, c - a, q - a) < 0;
      if (!same || !between) continue;
      ++met;
      EXPECT_NE(std::find(found.begin(), found.end(), f), found.end());
    }
  }
  EXPECT_GT(met, 100);
  EXPECT_LT(num_found, 1000U * 400U / 10U);
}

TEST(TriangleTree, WithoutTrianglesEverythingIsFar) {
  const TriangleTree tree;
  std::vector<int> found;
  tree.find(-Vec3::Ones(), Vec3::Ones(), 1, found);
  EXPECT_TRUE(found.empty());
  EXPECT_TRUE(std::isinf(tree.distance(Vec3::Zero())));
  EXPECT_FALSE(tree.is_within(Vec3::Zero(), 1e6));
}

}  // namespace articular::sim::triangle_tree_test
