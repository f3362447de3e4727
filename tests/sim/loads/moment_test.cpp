// A moment on a rigid body against closed forms: motion, equilibrium, reaction, work.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sim/model/constrained_rigid_body.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::moment_test {

constexpr double kInertia = 0.04;  // about z [kg m²]

double turned_about_z(const Simulation& run) {
  const Mat3& R = run.now().poses[0].R;
  return std::atan2(R(1, 0), R(0, 0));
}

// About a principal axis the angle is M t²/2I, and the work M times the angle. Where the body's
// center lies does not matter.
TEST(MomentLoad, TurnsAFreeBodyByItsInertiaAndDoesTheWorkOfTheAngle) {
  constexpr double kMoment = 0.6, kTime = 0.3;
  Scenario s = scene(1e-3, Integrator::Scheme::TrBdf2);
  s.bodies = {mass_body("top", 2, {0.1, -0.2, 0.3}, {0.03, 0.05, kInertia})};
  s.loads = {MomentLoad{"top", {0, 0, kMoment}, {}, {}}};
  Simulation run(s);
  run.advance(kTime);
  const double angle = kMoment * kTime * kTime / (2 * kInertia);
  EXPECT_GT(angle, 0.6);
  EXPECT_NEAR(turned_about_z(run), angle, 1e-6 * angle);
  EXPECT_NEAR(run.now().velocities[0].angular.z(), kMoment * kTime / kInertia, 1e-9);
  EXPECT_LT((run.now().poses[0].p - run.model.rigid_bodies[0].rest.p).norm(), 1e-12);
  EXPECT_NEAR(run.state.energy.load_work, kMoment * angle, 1e-6 * kMoment * angle);
}

// Its axis stays in space while the body turns beside it, and its profile scales it: from rest the
// angular momentum is the integral of the moment, whatever the inertia.
TEST(MomentLoad, GivesItsIntegralAsAngularMomentumAlongAnAxisThatStays) {
  const Vec3 moment(0.3, -0.5, 0.4), inertia(0.03, 0.05, kInertia);
  Scenario s = scene(1e-3, Integrator::Scheme::TrBdf2);
  s.bodies = {mass_body("top", 2, Vec3::Zero(), inertia)};
  s.loads = {MomentLoad{"top", moment, {{0, 0.4}, {0, 1}}, {}}};
  Simulation run(s);
  run.advance(0.4);
  const Mat3& R = run.now().poses[0].R;
  const Vec3 momentum = R * inertia.asDiagonal() * R.transpose() * run.now().velocities[0].angular;
  EXPECT_GT((R - Mat3::Identity()).norm(), 0.3);
  EXPECT_LT((momentum - 0.2 * moment).norm(), 1e-4 * moment.norm());
}

/// A wheel about the z axis whose rim a spring holds, turned by a moment.
Scenario wheel(double moment) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {mass_body("wheel", 1, Vec3::Zero(), Vec3(0.03, 0.05, kInertia)), stand("wall")};
  s.bodies[0].hold = Hold{{true, true, true, true, true, false}, Mat3::Identity(), Vec3::Zero()};
  Ligament spring;
  spring.name = "spring";
  spring.path = {anchor("wall", {0.1, -0.2, 0}), anchor("wheel", {0.1, 0, 0})};
  spring.stiffness = 500;
  s.ligaments = {spring};
  s.loads = {MomentLoad{"wheel", {0, 0, moment}, {}, {}}};
  return s;
}

// Nothing else acts: what small forces are is known by the moment alone. The spring's moment about
// the axis is its tension times its arm, both by the angle.
TEST(MomentLoad, IsInEquilibriumWithTheSpringOfAWheel) {
  constexpr double kMoment = 2;
  Simulation run(wheel(kMoment));
  run.advance(1);
  const double angle = turned_about_z(run);
  const Vec3 rim(0.1 * std::cos(angle), 0.1 * std::sin(angle), 0), wall(0.1, -0.2, 0);
  const Vec3 pull = 500 * ((rim - wall).norm() - 0.2) * (wall - rim).normalized();
  EXPECT_GT(angle, 0.2);
  EXPECT_NEAR(-rim.cross(pull).z(), kMoment, 1e-4 * kMoment);
}

TEST(MomentLoad, GoesIntoTheHoldWhereTheBodyCantTurn) {
  const Vec3 moment(0.3, -0.5, 2);
  Scenario s = wheel(0);
  s.loads = {MomentLoad{"wheel", moment, {}, {}}};
  Simulation run(s);
  run.advance(1);
  const Vec6 reaction = reaction_of(run.stepper.now(), 0);
  const double angle = turned_about_z(run);
  EXPECT_GT(angle, 0.2);
  EXPECT_NEAR(reaction[3], moment.x(), 1e-6);
  EXPECT_NEAR(reaction[4], moment.y(), 1e-6);
  EXPECT_EQ(reaction[5], 0);
}

}  // namespace articular::sim::moment_test
