// What is opposite what, and how much of it.
#include "sim/gap/contact_patch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/sim/support/patch_triangles.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::contact_patch_test {

constexpr double kRestArea = 0.7, kNodeArea = kRestArea / 3;
constexpr DepthRange kRange{10, 10};

TEST(ContactPatch, AParallelTriangleHasTheWholeAreaAndTheUniformDepth) {
  ContactPatch patch;
  ASSERT_TRUE(contact_patch(flat_triangle(small_triangle(0.25)), flat_triangle(large_face()),
                            kRestArea, kRange, patch));
  EXPECT_NEAR(patch.area, kRestArea, 1e-15);
  EXPECT_NEAR(patch.depth_max, 0.25, 1e-15);
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(nodal_areas(patch)[a], kNodeArea, 1e-15);
    EXPECT_NEAR(depth_integrals(patch)[a], 0.25 * kNodeArea, 1e-15);
  }
  // A uniform pressure pushes it out along the face's normal by p A.
  const Vec18 g = patch_gradient(patch, Vec3::Constant(2));
  EXPECT_NEAR(-(g[2] + g[5] + g[8]), 2 * kRestArea, 1e-14);
}

TEST(ContactPatch, AFaceOverPartOfTheTriangleTakesThatPart) {
  Mat3 f;  // covers x < 1/2
  f << 0.5, 0.5, -20, -50, 50, 0, 0, 0, 0;
  ContactPatch patch;
  ASSERT_TRUE(
      contact_patch(flat_triangle(small_triangle(0.1)), flat_triangle(f), 0.5, kRange, patch));
  EXPECT_NEAR(patch.area, 0.5 - 0.125, 1e-14);
  EXPECT_NEAR(depth_integrals(patch).sum(), 0.1 * 0.375, 1e-14);
}

TEST(ContactPatch, InFrontOfTheFaceTheDepthIsNegativeAndCountsToTheOpenDepth) {
  Mat3 s = small_triangle(0);
  s(2, 0) = -0.1;  // only this corner is behind the face, the others' depths are 0 and −0.1
  s(2, 2) = 0.1;
  ContactPatch patch;
  ASSERT_TRUE(contact_patch(flat_triangle(s), flat_triangle(large_face()), 0.5, kRange, patch));
  EXPECT_NEAR(patch.area, 0.5, 1e-14);
  EXPECT_NEAR(depth_integrals(patch).sum(), 0, 1e-15);
  // Measured along the triangle's normal; its plane is z = −0.1 + 0.2 x + 0.1 y.
  EXPECT_NEAR(patch.depth_max, 0.1 * std::sqrt(1.05), 1e-15);
  ASSERT_TRUE(contact_patch(flat_triangle(s), flat_triangle(large_face()), 0.5, {0, 10}, patch));
  EXPECT_NEAR(patch.area, 0.25, 1e-14);
}

/// Sums over the part whose depths count wholly and the part that fades.
struct Counted {
  double area = 0, depth = 0;
};
Counted counted(const Mat3& s, const DepthRange& range) {
  Counted sum;
  for (const int part : {ContactPatch::kFace, ContactPatch::kFading}) {
    ContactPatch patch;
    if (!contact_patch(flat_triangle(s), flat_triangle(large_face()), 0.5, range, patch, part))
      continue;
    sum.area += nodal_areas(patch).sum();
    sum.depth += depth_integrals(patch).sum();
    EXPECT_NEAR(patch.area, nodal_areas(patch).sum(), 1e-15);
    EXPECT_LE(patch.depth_max, part == ContactPatch::kFading ? -0.5 * range.open + 1e-15 : 1);
  }
  return sum;
}

// ω = 2 + d/h between −2h and −h; a parallel triangle counts as a whole.
TEST(ContactPatch, InFrontOfTheFaceDepthsFadeIn) {
  const double h = 0.2;
  for (const double gap : {0.1, 0.2, 0.25, 0.3, 0.39, 0.4, 0.5}) {
    const double weight = std::clamp(2 - gap / h, 0.0, 1.0);
    const Counted sum = counted(small_triangle(-gap), {2 * h, 10});
    EXPECT_NEAR(sum.area, 0.5 * weight, 1e-14);
    EXPECT_NEAR(sum.depth, -0.5 * std::min(gap, h) * weight, 1e-14);
  }
}

// Against a sum over small parts of the triangle, each at one gap.
TEST(ContactPatch, OnATriangleThatCrossesAllRangesTheIntegralsAreThoseOfTheWeight) {
  const double h = 0.2;
  Mat3 s = small_triangle(-0.2);
  s(2, 0) -= 0.25;  // behind the face by 0.05
  s(2, 1) += 0.3;
  Counted expected;
  const int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n - i; ++j)
      for (const double third : {1.0 / 3, 2.0 / 3}) {
        if (third > 0.5 && j == n - i - 1) continue;
        const double a = (i + third) / n, b = (j + third) / n;
        const double z = s(2, 0) + a * (s(2, 1) - s(2, 0)) + b * (s(2, 2) - s(2, 0));
        // Along the triangle's own normal.
        const double d = -z / std::abs(flat_triangle(s).normal.z());
        const double weight = std::clamp(2 + d / h, 0.0, 1.0);
        expected.area += 0.5 / (n * n) * weight;
        expected.depth += 0.5 / (n * n) * std::max(d, -h) * weight;
      }
  const Counted sum = counted(s, {2 * h, 10});
  EXPECT_GT(expected.area, 0.1);
  EXPECT_NEAR(sum.area, expected.area, 1e-5);
  EXPECT_NEAR(sum.depth, expected.depth, 1e-5);
}

TEST(ContactPatch, InFrontOfTheFaceOrBesideItOrDeeperThanTheReachIsNoContact) {
  ContactPatch patch;
  EXPECT_FALSE(contact_patch(flat_triangle(small_triangle(-0.1)), flat_triangle(large_face()), 1,
                             {0.05, 10}, patch));
  EXPECT_FALSE(contact_patch(flat_triangle(small_triangle(0.1)), flat_triangle(large_face()), 1,
                             {10, 0.05}, patch));
  // An allowance is taken from depths, and not added to the reach.
  Mat3 tilted = small_triangle(0.1);
  tilted(2, 0) = -0.3;
  const FlatTriangle half_deep = flat_triangle(tilted);
  EXPECT_TRUE(contact_patch(half_deep, flat_triangle(large_face()), 1, {0, 0.35, 0.15}, patch));
  EXPECT_FALSE(contact_patch(half_deep, flat_triangle(large_face()), 1, {0, 0.25, 0.15}, patch));
  Mat3 beside = small_triangle(0.1);
  beside.row(0).array() += 100;
  EXPECT_FALSE(contact_patch(flat_triangle(beside), flat_triangle(large_face()), 1, kRange, patch));
  Mat3 back = small_triangle(0.1);
  back.col(1).swap(back.col(2));
  EXPECT_FALSE(contact_patch(flat_triangle(back), flat_triangle(large_face()), 1, kRange, patch));
}

TEST(ContactPatch, TrianglesWithoutAreaTouchNothing) {
  Mat3 line;
  line << 0, 1, 2, 0, 1, 2, -0.1, -0.1, -0.1;
  const Mat3 point = Vec3(0, 0, -0.1) * Eigen::RowVector3d::Ones();
  const Mat3 nan = Mat3::Constant(std::numeric_limits<double>::quiet_NaN());
  ContactPatch patch;
  for (const Mat3& bad : {line, point, nan}) {
    EXPECT_FALSE(contact_patch(flat_triangle(bad), flat_triangle(large_face()), 1, kRange, patch));
    EXPECT_FALSE(
        contact_patch(flat_triangle(small_triangle(0.1)), flat_triangle(bad), 1, kRange, patch));
  }
}

TEST(ContactPatch, NearlyFlatTrianglesGiveFiniteForces) {
  for (const double width : {1e-6, 1e-9, 1e-12, 1e-15}) {
    Mat3 s = small_triangle(0.1);
    s(1, 1) = width;
    ContactPatch patch;
    if (!contact_patch(flat_triangle(s), flat_triangle(large_face()), 1, kRange, patch)) continue;
    EXPECT_TRUE(patch_gradient(patch, Vec3::Ones()).allFinite()) << width;
    EXPECT_TRUE(patch_curvature(patch, {Vec3::Ones()}).allFinite()) << width;
  }
}

// Corners on the face's edges, within round-off of them on either side.
TEST(ContactPatch, CornersOnTheFacesEdgesAreSafe) {
  Random random(7);
  const Mat3 f = large_face();
  for (int n = 0; n < 2000; ++n) {
    Mat3 s;
    for (int i = 0; i < 3; ++i) {
      const double along = 0.5 + 0.5 * random();
      s.col(i) = (1 - along) * f.col(i) + along * f.col((i + 1) % 3) + 1e-15 * random.vec3();
      s(2, i) -= 0.1;
    }
    s.col(1).swap(s.col(2));
    ContactPatch patch;
    if (!contact_patch(flat_triangle(s), flat_triangle(f), 1, kRange, patch)) continue;
    EXPECT_LE(patch.area, 1 + 1e-12);
    EXPECT_TRUE(patch_gradient(patch, Vec3::Ones()).allFinite());
  }
}

}  // namespace articular::sim::contact_patch_test
