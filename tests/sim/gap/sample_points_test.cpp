// Contact at sample points of each triangle.
#include "sim/gap/sample_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/support/patch_triangles.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::sample_points_test {

constexpr DepthRange kBehind{0, 10};
constexpr double kRestArea = 0.5;

/// N_0^i N_1^j N_2^k by the rule.
double sum_of(int i, int j, int k) {
  double sum = 0;
  for (const auto& [N, part] : triangle_samples())
    sum += part * std::pow(N[0], i) * std::pow(N[1], j) * std::pow(N[2], k);
  return sum;
}

// ∫ N_0^i N_1^j N_2^k dA = 2 A i! j! k!/(i + j + k + 2)!
TEST(TriangleSamples, IntegratePolynomialsUpToTheFifthDegree) {
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  const auto exact = [&](int i, int j, int k) {
    return 2 * factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 2);
  };
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; i + j <= 5; ++j)
      for (int k = 0; i + j + k <= 5; ++k)
        EXPECT_NEAR(sum_of(i, j, k), exact(i, j, k), 1e-6 * exact(0, 0, 0)) << i << j << k;
  EXPECT_GT(std::abs(sum_of(6, 0, 0) - exact(6, 0, 0)), 1e-5);
}

TEST(SampledPatch, OfACoveredTriangleIsTheExactOne) {
  Random random(1);
  for (int n = 0; n < 20; ++n) {
    Mat3 s = small_triangle(0.5);
    for (int i = 0; i < 3; ++i) s.col(i) += 0.2 * random.vec3();
    ContactPatch exact, sampled;
    ASSERT_TRUE(
        contact_patch(flat_triangle(s), flat_triangle(large_face()), kRestArea, kBehind, exact));
    ASSERT_TRUE(contact_patch(flat_triangle(s), flat_triangle(large_face()), kRestArea, kBehind,
                              sampled, triangle_samples()));
    EXPECT_LT((exact.Q - sampled.Q).norm(), 1e-6 * exact.Q.norm());
    EXPECT_NEAR(exact.area, sampled.area, 1e-12);
    EXPECT_LE(sampled.depth_max, exact.depth_max);
  }
}

// The faces' common edges run through the triangle's centre and through corners: each point counts
// once all the same.
TEST(SampledPatch, PointsOverEdgesBetweenFacesCountOnce) {
  const Vec3 center(1.0 / 3, 1.0 / 3, 0);
  const Vec3 around[] = {{-1, -1, 0}, {2, 0.5, 0}, {1.0 / 3, 3, 0}};
  double area = 0;
  for (int k = 0; k < 3; ++k) {
    Mat3 f;
    f << center, around[k], around[(k + 1) % 3];
    ContactPatch patch;
    if (contact_patch(flat_triangle(small_triangle(0.1)), flat_triangle(f), kRestArea, kBehind,
                      patch, triangle_samples()))
      area += patch.area;
  }
  EXPECT_NEAR(area, kRestArea, 1e-12);
}

double energy(const Mat3& s) {
  ContactPatch patch;
  return contact_patch(flat_triangle(s), flat_triangle(large_face()), kRestArea, kBehind, patch,
                       triangle_samples())
             ? value(patch, point_energy(patch, 1))
             : 0;
}

// Some points are in front of the face, and none comes or goes.
TEST(SampledPatch, TheGradientIsTheDerivativeOfTheEnergy) {
  Random random(2);
  int crossing = 0;
  for (int n = 0; n < 50; ++n) {
    Mat3 s = small_triangle(0);
    for (int i = 0; i < 3; ++i) s.col(i) += 0.2 * random.vec3();
    ContactPatch patch;
    if (!contact_patch(flat_triangle(s), flat_triangle(large_face()), kRestArea, kBehind, patch,
                       triangle_samples()))
      continue;
    crossing += patch.area < 0.99 * kRestArea ? 1 : 0;
    const Vec18 g = patch_gradient(patch, point_energy(patch, 1));
    for (int i = 0; i < 9; ++i) {
      constexpr double h = 1e-5;
      Mat3 plus = s, minus = s;
      plus.reshaped()[i] += h;
      minus.reshaped()[i] -= h;
      EXPECT_NEAR((energy(plus) - energy(minus)) / (2 * h), g[i], 1e-5 * g.norm());
    }
  }
  EXPECT_GT(crossing, 10);
}

}  // namespace articular::sim::sample_points_test
