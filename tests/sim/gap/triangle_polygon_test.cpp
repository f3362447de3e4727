#include "sim/gap/triangle_polygon.hpp"

#include <gtest/gtest.h>

namespace articular::sim::triangle_polygon_test {

// With a weight that is 1 everywhere, and in a triangle where the integrals are known.
TEST(TrianglePolygon, TheWeightedIntegralHasTheWeightAtEachPoint) {
  const TrianglePolygon whole = whole_triangle();
  TrianglePolygon room;
  const TrianglePolygon& part = clipped({0.3, -0.2, 0.6}, 0, whole, room);
  ASSERT_EQ(part.count, 4);
  Mat3 Q;
  integrate(part, Q);
  EXPECT_LT((weighted_integral(part, Vec3::Ones()) - Q).norm(), 1e-15);
  for (int i = 0; i < 3; ++i)  // Σ_j N_j = 1
    EXPECT_LT((weighted_integral(part, Vec3::Unit(i)).rowwise().sum() - Q.col(i)).norm(), 1e-15);
  const Mat3 over_whole = weighted_integral(whole, Vec3::Unit(0));
  EXPECT_NEAR(over_whole(0, 0), 0.1, 1e-15);
  EXPECT_NEAR(over_whole(1, 1), 1.0 / 30, 1e-15);
  EXPECT_NEAR(over_whole(1, 0), 1.0 / 30, 1e-15);
  EXPECT_NEAR(over_whole(1, 2), 1.0 / 60, 1e-15);
}

}  // namespace articular::sim::triangle_polygon_test
