// How deep a straight line runs through a solid, against closed forms.
#include "sim/mesh/chord_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/sim/wrap/wrap_shapes.hpp"

namespace articular::sim::chord_depth_test {

double depth(const wrap_test::Shape& shape, const Vec3& a, const Vec3& b) {
  return chord_depth(shape.X, shape.triangles, shape.tree, a, b);
}

constexpr double kFacets = 2e-4;  // [m] between them and the surfaces that they stand for

/// The deepest point lies between two of the places.
double tolerance(const Vec3& a, const Vec3& b) { return 0.005 * (b - a).norm() + kFacets; }

TEST(ChordDepth, OfABallIsTheRadiusLessTheDistanceFromTheCentre) {
  const double radius = 0.03;
  const wrap_test::Shape ball = wrap_test::ellipsoid(12, Vec3::Constant(radius));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int through = 0;
  for (int i = 0; i < 60; ++i) {
    const auto any = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
    const Vec3 along = any().normalized();
    const Vec3 beside = along.cross(any()).normalized();
    const double distance = 1.3 * radius * std::abs(uniform(random));
    const Vec3 a = distance * beside - 0.05 * along, b = distance * beside + 0.06 * along;
    const double expected = std::max(0.0, radius - distance);
    EXPECT_NEAR(depth(ball, a, b), expected, tolerance(a, b));
    EXPECT_NEAR(depth(ball, b, a), expected, tolerance(a, b));
    EXPECT_NEAR(depth_inside(ball.X, ball.triangles, ball.tree, distance * beside), expected,
                kFacets);
    through += distance < radius ? 1 : 0;
  }
  EXPECT_GT(through, 20);
  EXPECT_LT(through, 55);
}

TEST(ChordDepth, OfATorusIsThatOfTheTubeAndNothingInTheHole) {
  const wrap_test::Shape torus = wrap_test::grid(48, 32, true, [](double u, double v) {
    const double a = 2 * wrap_test::kPi * u, b = 2 * wrap_test::kPi * v;
    const double c = 0.04 + 0.01 * std::cos(b);
    return Vec3(c * std::cos(a), c * std::sin(a), 0.01 * std::sin(b));
  });
  const auto expect = [&](const Vec3& a, const Vec3& b, double expected) {
    EXPECT_NEAR(depth(torus, a, b), expected, expected > 0 ? tolerance(a, b) : 0);
  };
  expect({0.005, 0, -0.05}, {0.005, 0, 0.05}, 0);
  expect({-0.06, 0.0001, 0}, {0.06, 0.0001, 0}, 0.01);
  expect({0, 0.0001, 0.004}, {0.06, 0.0001, 0.004}, 0.006);
}

TEST(ChordDepth, OfALineThatEndsInsideIsThatOfItsInnerPart) {
  const wrap_test::Shape ball = wrap_test::ellipsoid(12, Vec3::Constant(0.03));
  EXPECT_NEAR(depth(ball, {0.028, 0, 0}, {0.04, 0, 0}), 0.002, kFacets);
  EXPECT_NEAR(depth(ball, {0.005, 0, 0}, {0.006, 0, 0}), 0.025, kFacets);  // meets no triangle
}

}  // namespace articular::sim::chord_depth_test
