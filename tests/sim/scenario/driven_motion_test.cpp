// Splines through the samples of a motion.
#include "sim/scenario/driven_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

namespace articular::sim::driven_motion_test {

Motion spline(const std::vector<double>& time, Motion::Ends ends,
              const std::function<Vec3(double)>& shift, const std::function<Vec3(double)>& turn) {
  Motion motion;
  motion.time = time;
  for (const double t : time) {
    motion.translation.push_back(shift(t));
    motion.rotation.push_back(turn(t));
  }
  motion.about = {0.1, -0.2, 0.05};
  motion.interpolation = Motion::Interpolation::Spline;
  motion.ends = ends;
  fit_spline(motion);
  return motion;
}

Vec3 wavy_shift(double t) { return {std::sin(3 * t), 0.3 * t * t, std::cos(5 * t)}; }
Vec3 wavy_turn(double t) {
  return {2 * std::sin(2 * t), 1.5 * std::cos(3 * t), 4 * t};
}  // beyond π

const std::vector<double> kUneven = {0, 0.1, 0.15, 0.4, 0.55, 0.9, 1};

// A cubic that rests at both ends is its own clamped spline, whatever the samples.
TEST(Spline, ThatRestsReproducesACubicThatDoes) {
  const auto cubic = [](double t) -> Vec3 { return t * t * (3 - 2 * t) * Vec3(1, -2, 0.5); };
  const Motion motion =
      spline(kUneven, Motion::Ends::Rest, cubic, [](double) { return Vec3(0, 0, 0); });
  for (const double t : {0.03, 0.1, 0.3, 0.5, 0.77, 0.99}) {
    EXPECT_LT((driven_pose(motion, Pose{}, t).p - cubic(t)).norm(), 1e-14);
    const Vec3 rate = 6 * t * (1 - t) * Vec3(1, -2, 0.5), second = (6 - 12 * t) * Vec3(1, -2, 0.5);
    EXPECT_LT((driven_velocity(motion, Pose{}, t).linear - rate).norm(), 1e-13);
    EXPECT_LT((driven_acceleration(motion, {t, false}).linear - second).norm(), 1e-12);
  }
}

class SplineEnds : public ::testing::TestWithParam<Motion::Ends> {};
INSTANTIATE_TEST_SUITE_P(Each, SplineEnds,
                         ::testing::Values(Motion::Ends::Rest, Motion::Ends::Moving));

TEST_P(SplineEnds, GoesThroughAllSamplesExactly) {
  const Motion motion = spline(kUneven, GetParam(), wavy_shift, wavy_turn);
  for (std::size_t i = 0; i < kUneven.size(); ++i) {
    const Pose pose = driven_pose(motion, {motion.about, Mat3::Identity()}, kUneven[i]);
    EXPECT_LT((pose.p - motion.about - motion.translation[i]).norm(), 1e-15);
    EXPECT_LT((pose.R - rotation_matrix(motion.rotation[i])).norm(), 1e-14);
  }
}

// Before and after each sample within: pose, velocity and acceleration, of shift and turn.
TEST_P(SplineEnds, HasContinuousAccelerations) {
  const Motion motion = spline(kUneven, GetParam(), wavy_shift, wavy_turn);
  const Pose rest{{0.5, 0.3, -0.2}, Mat3::Identity()};
  for (std::size_t i = 1; i + 1 < kUneven.size(); ++i) {
    constexpr double h = 1e-9;
    const double t = kUneven[i];
    const RigidVelocity before = driven_acceleration(motion, {t - h, false}),
                        after = driven_acceleration(motion, {t + h, true});
    EXPECT_GT(before.linear.norm() + before.angular.norm(), 1);
    EXPECT_LT((before.linear - after.linear).norm(), 1e-5);
    EXPECT_LT((before.angular - after.angular).norm(), 1e-4);
    EXPECT_LT(
        (driven_velocity(motion, rest, t - h).linear - driven_velocity(motion, rest, t + h).linear)
            .norm(),
        1e-6);
  }
}

TEST_P(SplineEnds, AccelerationIsTheDerivativeOfTheVelocity) {
  const Motion motion = spline(kUneven, GetParam(), wavy_shift, wavy_turn);
  const Pose at_centre{motion.about, Mat3::Identity()};
  for (const double t : {0.05, 0.2, 0.41, 0.7, 0.93}) {
    constexpr double h = 1e-5;
    const RigidVelocity a = driven_velocity(motion, at_centre, t - h),
                        b = driven_velocity(motion, at_centre, t + h),
                        rate = driven_acceleration(motion, {t, false});
    EXPECT_LT(((b.linear - a.linear) / (2 * h) - rate.linear).norm(), 1e-6);
    EXPECT_LT(((b.angular - a.angular) / (2 * h) - rate.angular).norm(), 1e-5);
  }
}

TEST(Spline, ThatRestsStandsBeforeAndAfter) {
  const Motion motion = spline(kUneven, Motion::Ends::Rest, wavy_shift, wavy_turn);
  for (const double t : {-0.5, 0.0, 1.0, 1.5}) {
    EXPECT_EQ(driven_velocity(motion, Pose{}, t).linear, Vec3::Zero());
    EXPECT_EQ(driven_velocity(motion, Pose{}, t).angular, Vec3::Zero());
  }
  EXPECT_LT(driven_velocity(motion, Pose{}, 1e-9).linear.norm(), 1e-6);
  EXPECT_LT(driven_velocity(motion, Pose{}, 1 - 1e-9).linear.norm(), 1e-6);
  EXPECT_EQ(kinks_of(motion), (std::vector<double>{0, 1}));
}

// A natural spline has no acceleration at its ends, and goes on with none: there is no kink.
TEST(Spline, ThatMovesAtItsEndsGoesOnStraight) {
  const Motion motion = spline(kUneven, Motion::Ends::Moving, wavy_shift, wavy_turn);
  EXPECT_TRUE(kinks_of(motion).empty());
  for (const double end : {0.0, 1.0}) {
    const Vec3 v = driven_velocity(motion, {motion.about, Mat3::Identity()}, end).linear;
    EXPECT_GT(v.norm(), 0.5);
    const double beyond = end == 0 ? -0.3 : 1.3;
    EXPECT_LT((driven_velocity(motion, {motion.about, Mat3::Identity()}, beyond).linear - v).norm(),
              1e-14);
    const Vec3 way = driven_pose(motion, {motion.about, Mat3::Identity()}, beyond).p -
                     driven_pose(motion, {motion.about, Mat3::Identity()}, end).p;
    EXPECT_LT((way - (beyond - end) * v).norm(), 1e-14);
    EXPECT_LT(driven_acceleration(motion, {end, end == 0}).linear.norm(), 1e-12);
  }
}

// Samples of a course that rests at both ends: the error of the pose falls with h⁴.
TEST(Spline, ConvergesWithTheFourthOrder) {
  const auto course = [](double t) { return t * t * (3 - 2 * t); };
  const auto shift = [&](double t) { return wavy_shift(course(t)); };
  const auto turn = [&](double t) { return wavy_turn(course(t)); };
  const auto error = [&](int parts) {
    std::vector<double> time;
    for (int i = 0; i <= parts; ++i) time.push_back(static_cast<double>(i) / parts);
    const Motion motion = spline(time, Motion::Ends::Rest, shift, turn);
    double largest = 0;
    for (int k = 0; k < 997; ++k) {
      const double t = (k + 0.5) / 997;
      const Pose pose = driven_pose(motion, {motion.about, Mat3::Identity()}, t);
      largest = std::max({largest, (pose.p - motion.about - shift(t)).norm(),
                          (pose.R - rotation_matrix(turn(t))).norm()});
    }
    return largest;
  };
  EXPECT_LT(error(40), 1e-4);
  EXPECT_NEAR(std::log2(error(20) / error(40)), 4, 0.5);
}

}  // namespace articular::sim::driven_motion_test
