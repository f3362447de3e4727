#include "sim/base/pose.hpp"
#include "sim/model/mass_properties.hpp"
#include "sim/scenario/driven_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "collision/mesh/surface.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::rigid_body_test {

MassProperties of_mesh(const MeshData& mesh, double density) {
  const auto surface = collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols()));
  return solid_mass_properties(mesh.X, surface.faces, density);
}

Mat3 box_inertia(double mass, const Vec3& size) {
  const Vec3 square = size.cwiseProduct(size);
  return (mass / 12 * (square.sum() * Vec3::Ones() - square)).asDiagonal();
}

TEST(RigidBody, ABoxFarFromTheOriginHasItsClosedFormMassProperties) {
  const Vec3 size(0.02, 0.03, 0.05), center(1, -2, 3);
  const MassProperties box = of_mesh(box_mesh({size, {2, 3, 2}, center}), 1200);
  const double mass = 1200 * size.prod();
  EXPECT_NEAR(box.mass, mass, 1e-12 * mass);
  EXPECT_NEAR((box.center - center).norm(), 0, 1e-12 * size.norm());
  EXPECT_NEAR((box.inertia - box_inertia(mass, size)).norm(), 0, 1e-10 * box.inertia.norm());
}

TEST(RigidBody, ASpheresInertiaConvergesToTwoFifthsOfMassTimesSquaredRadius) {
  const auto error = [](double size) {
    const MassProperties ball = of_mesh(sphere_mesh({1, size, Vec3::Zero()}), 1);
    const double exact = 0.4 * 4.0 / 3 * std::numbers::pi;
    EXPECT_NEAR(ball.center.norm(), 0, 1e-12);
    return (ball.inertia - exact * Mat3::Identity()).norm();
  };
  EXPECT_NEAR(std::log2(error(1.0 / 4) / error(1.0 / 8)), 2, 0.1);
}

TEST(RigidBody, TwoHalvesJoinToTheWholeBox) {
  const Vec3 size(0.02, 0.03, 0.04), half(0.02, 0.03, 0.02);
  const double mass = 1000 * size.prod();
  const auto part = [&](double z) {
    return MassProperties{0.5 * mass, {0.1, 0.2, z}, box_inertia(0.5 * mass, half)};
  };
  const MassProperties whole = join(part(-0.01), part(0.01));
  EXPECT_NEAR(whole.mass, mass, 1e-15);
  EXPECT_NEAR((whole.center - Vec3(0.1, 0.2, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((whole.inertia - box_inertia(mass, size)).norm(), 0, 1e-12 * whole.inertia.norm());
}

TEST(RigidBody, NothingJoinedChangesNothing) {
  const MassProperties a{2, {1, 2, 3}, Mat3::Identity()};
  const MassProperties joined = join(a, {});
  EXPECT_EQ(joined.mass, 2);
  EXPECT_EQ(joined.center, a.center);
  EXPECT_EQ(joined.inertia, a.inertia);
}

/// Shifts and turns by large angles about changing axes.
Motion large_motion(Motion::Interpolation interpolation) {
  Motion motion;
  motion.time = {0, 0.4, 1.1};
  motion.translation = {Vec3::Zero(), {0.1, 0, -0.2}, {0.3, 0.2, 0}};
  motion.rotation = {Vec3::Zero(), {1.5, -2.0, 0.7}, {-0.5, 2.5, 1.9}};
  motion.about = Vec3(0.2, -0.1, 0.05);
  motion.interpolation = interpolation;
  fit_spline(motion);
  return motion;
}

class DrivenMotion : public ::testing::TestWithParam<Motion::Interpolation> {};

// Best of a sweep of central differences; the motion's own scales are 1 m and 1 rad/s.
TEST_P(DrivenMotion, VelocityIsTheDerivativeOfThePose) {
  const Motion motion = large_motion(GetParam());
  const Pose rest{{0.5, 0.3, -0.2}, Mat3::Identity()};
  for (const double t : {1e-3, 0.1, 0.2, 0.39, 0.41, 0.7, 1.0, 1.0999}) {
    const RigidVelocity v = driven_velocity(motion, rest, t);
    double best = std::numeric_limits<double>::infinity();
    for (const double dt : {1e-4, 1e-5, 1e-6}) {
      const Pose a = driven_pose(motion, rest, t - dt), b = driven_pose(motion, rest, t + dt);
      const Mat3 spin = (b.R - a.R) / (2 * dt) * driven_pose(motion, rest, t).R.transpose();
      best = std::min(best,
                      ((b.p - a.p) / (2 * dt) - v.linear).norm() + (spin - skew(v.angular)).norm());
    }
    EXPECT_LT(best, 1e-7) << "t = " << t;
  }
}

TEST_P(DrivenMotion, RestsBeforeItsFirstAndAfterItsLastTime) {
  const Motion motion = large_motion(GetParam());
  const Pose rest{{0.5, 0.3, -0.2}, Mat3::Identity()};
  EXPECT_NEAR((driven_pose(motion, rest, -1).p - rest.p).norm(), 0, 1e-16);
  for (const double t : {-1.0, 2.0}) {
    EXPECT_EQ(driven_velocity(motion, rest, t).linear, Vec3::Zero());
    EXPECT_EQ(driven_velocity(motion, rest, t).angular, Vec3::Zero());
  }
  EXPECT_NEAR((driven_pose(motion, rest, 2).R - rotation_matrix(motion.rotation.back())).norm(), 0,
              1e-15);
}

INSTANTIATE_TEST_SUITE_P(RigidBody, DrivenMotion,
                         ::testing::Values(Motion::Interpolation::Linear,
                                           Motion::Interpolation::Smooth,
                                           Motion::Interpolation::Spline));

TEST(RigidBody, ASmallRotationVectorTurnsLikeTheCrossProduct) {
  const Vec3 theta(1e-9, -2e-9, 3e-9);
  EXPECT_NEAR((rotation_matrix(theta) - Mat3::Identity() - skew(theta)).norm(), 0, 1e-16);
}

// A rod of 20 x 20 x 200 mm spins twice about an axis across it: the axis stays where it is in the
// rod. By a tolerance of 1/2000 of its radius an iteration too few in each step made it roll.
TEST(RigidBody, ARodThatSpinsDoesNotRollWithTheDefaultTolerance) {
  using enum Integrator::Scheme;
  for (const auto scheme : {ImplicitEuler, TrBdf2, Explicit}) {
    Scenario s = scene(1e-3, scheme);
    s.integrator.position_tolerance.reset();
    s.bodies = {box_body("rod", Body::Kind::Rigid, {0.02, 0.02, 0.2}, Vec3::Zero())};
    s.bodies[0].density = 1000;
    s.bodies[0].angular_velocity = Vec3(0, 4 * std::numbers::pi, 0);
    Simulation run(s);
    run.advance(1);
    const Vec3 axis = run.now().poses[0].R.col(1);
    EXPECT_LT((axis - Vec3::UnitY()).norm(), 1e-4) << static_cast<int>(scheme);
  }
}

}  // namespace articular::sim::rigid_body_test
