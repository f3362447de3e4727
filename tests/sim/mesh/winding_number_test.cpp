#include "sim/mesh/winding_number.hpp"

#include <gtest/gtest.h>

#include "tests/sim/wrap/wrap_shapes.hpp"

namespace articular::sim::winding_number_test {

TEST(WindingNumber, IsOneInsideAndNothingOutside) {
  const wrap_test::Shape ball = wrap_test::ellipsoid(6, {0.03, 0.02, 0.05});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 50; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 d = Vec3(x, y, z).normalized().cwiseProduct(Vec3(0.03, 0.02, 0.05));
    EXPECT_NEAR(winding_number(ball.X, ball.triangles, 0.9 * d), 1, 1e-9);
    EXPECT_NEAR(winding_number(ball.X, ball.triangles, 1.01 * d), 0, 1e-9);
  }
}

TEST(WindingNumber, OfASurfaceInsideOutIsLessThanNothing) {
  wrap_test::Shape ball = wrap_test::ellipsoid(3, Vec3::Constant(0.03));
  ball.triangles.row(0).swap(ball.triangles.row(1));
  EXPECT_NEAR(winding_number(ball.X, ball.triangles, Vec3::Zero()), -1, 1e-12);
}

TEST(IsClosed, SaysWhetherASurfaceHasBordersOrTrianglesThatFaceEachOther) {
  const wrap_test::Shape ball = wrap_test::ellipsoid(3, Vec3::Constant(0.03));
  EXPECT_TRUE(is_closed(ball.triangles));
  EXPECT_FALSE(is_closed(wrap_test::cylinder(8, 3, 0.01, 0.1).triangles));
  EXPECT_FALSE(is_closed(ball.triangles.leftCols(ball.triangles.cols() - 1)));
  EXPECT_FALSE(is_closed(Triangles(3, 0)));
  Triangles turned = ball.triangles;
  turned.col(4).reverseInPlace();
  EXPECT_FALSE(is_closed(turned));
}

}  // namespace articular::sim::winding_number_test
