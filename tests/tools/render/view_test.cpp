#include "tools/render/view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "sim/base/error.hpp"

namespace articular::tools::render_test {

// In the picture every point lies within the panel, and one of its sides is filled but for the
// margin.
TEST(View, EveryPointLiesInThePanelAndOneSideIsFilled) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-1, 1);
  const auto point = [&] { return Vec3(value(random), 0.3 * value(random), value(random)); };
  int wide = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vec3 to_eye = point().normalized();
    const Vec3 right = to_eye.unitOrthogonal();
    const ViewAxes axes{right, to_eye.cross(right), to_eye};
    ViewBox box(axes);
    std::vector<Vec3> points(20);
    for (Vec3& p : points) box.add(p = point());
    constexpr double kAspect = 1.3;
    const double half = half_height_for(box.size(), kAspect);
    double x = 0, y = 0;
    for (const Vec3& p : points) {
      x = std::max(x, std::abs((p - box.middle()).dot(axes.right)) / (kAspect * half));
      y = std::max(y, std::abs((p - box.middle()).dot(axes.up)) / half);
    }
    EXPECT_LT(std::max(x, y), 1);
    EXPECT_GT(std::max(x, y), 0.95);
    wide += x > y ? 1 : 0;
  }
  EXPECT_GT(wide, kTrials / 20);  // both cases occur
  EXPECT_LT(wide, kTrials * 19 / 20);
}

TEST(View, IsFromWhereItsNameSays) {
  EXPECT_EQ(view_axes("front", "", {}).to_eye, -Vec3::UnitY());
  EXPECT_EQ(view_axes("front", "y", {}).to_eye, Vec3::UnitZ());
  EXPECT_EQ(view_axes("left", "y", {}).to_eye, Vec3::UnitX());
  EXPECT_EQ(view_axes("top", "", {}).up, -Vec3::UnitY());
}

TEST(View, FollowsTheDirectionsThatAScenarioStates) {
  // x anterior, y superior, so that left is −z.
  const Directions directions = {"anterior", "superior", "right"};
  const ViewAxes front = view_axes("front", "", directions);
  EXPECT_EQ(front.to_eye, Vec3::UnitX());
  EXPECT_EQ(front.up, Vec3::UnitY());
  EXPECT_EQ(view_axes("left", "", directions).to_eye, -Vec3::UnitZ());
  EXPECT_EQ(view_axes("right", "", directions).to_eye, Vec3::UnitZ());
}

TEST(View, UnknownOnesAreRefused) {
  EXPECT_THROW(view_axes("behind", "", {}), sim::InputError);
  EXPECT_THROW(view_axes("front", "x", {}), sim::InputError);
}

}  // namespace articular::tools::render_test
