// Which points lie inside a closed surface, and how deep, against solid angles and closed forms.
#include "sim/mesh/deepest_inside.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/mesh/winding_number.hpp"
#include "tests/sim/wrap/wrap_shapes.hpp"

namespace articular::sim::deepest_inside_test {

Solid solid(const wrap_test::Shape& shape) { return {shape.X, shape.triangles}; }

wrap_test::Shape torus(double way, double radius) {
  return wrap_test::grid(40, 24, true, [=](double u, double v) {
    const double a = 2 * wrap_test::kPi * u, b = 2 * wrap_test::kPi * v;
    const double out = way + radius * std::cos(b);
    return Vec3(out * std::cos(a), out * std::sin(a), radius * std::sin(b));
  });
}

Positions random_points(int count, double reach, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-reach, reach);
  return Positions::NullaryExpr(3, count, [&] { return uniform(random); });
}

TEST(Solid, HoldsThePointsThatItGoesRound) {
  const Solid ring = solid(torus(0.03, 0.012));
  Solid inside_out = ring;
  inside_out.triangles.row(0).swap(inside_out.triangles.row(1));
  int held = 0;
  const Positions points = random_points(2000, 0.04, 5);
  for (const Vec3 x : points.colwise()) {
    const bool within = winding_number(ring.X, ring.triangles, x) > 0.5;
    EXPECT_EQ(ring.contains(x), within) << x.transpose();
    EXPECT_EQ(inside_out.contains(x), within) << x.transpose();
    held += within ? 1 : 0;
  }
  EXPECT_GT(held, 100);  // and most lie in the hole or outside
  EXPECT_FALSE(ring.contains(Vec3::Zero()));
}

TEST(DeepestInside, IsThePointThatIsFarthestFromTheSurface) {
  const double radius = 0.03;
  const Solid ball = solid(wrap_test::ellipsoid(12, Vec3::Constant(radius)));
  const Positions points = random_points(300, 0.05, 7);
  Eigen::Index nearest = 0;
  const double distance = points.colwise().norm().minCoeff(&nearest);
  const auto found = deepest_inside(points, ball, 0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->x, points.col(nearest));
  EXPECT_NEAR(found->depth, radius - distance, 2e-4);
  EXPECT_TRUE(deepest_inside(points, ball, 0.99 * found->depth));
  EXPECT_FALSE(deepest_inside(points, ball, 1.01 * found->depth));
}

TEST(DeepestInside, IsNoneOfPointsOutside) {
  const Solid ball = solid(wrap_test::ellipsoid(8, Vec3::Constant(0.01)));
  EXPECT_FALSE(deepest_inside(Vec3(0.0101, 0, 0), ball, 0));
  EXPECT_FALSE(deepest_inside(Vec3(0.008, 0.008, 0), ball, 0));
  EXPECT_FALSE(deepest_inside(Positions(3, 0), ball, 0));
}

}  // namespace articular::sim::deepest_inside_test
