// The scheme that chooses its steps: errors follow the tolerance, a restart is the same run.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/sim/support/scene.hpp"

namespace articular::sim::adaptive_test {

using Scheme = Integrator::Scheme;

/// A bar tied at one end that was given a sideways velocity.
Scenario swinging_bar(Scheme scheme, double tolerance) {
  Scenario s = scene(5e-3, scheme);
  s.integrator.position_tolerance = tolerance;
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.01, 0.01, 0.03}, {0, 0, 0.015}, {1, 1, 3}),
              stand("wall")};
  s.bodies[0].velocity = {0.1, 0, 0};
  s.attachments = {attach("bar", "wall", {-1, -1, -1e-6}, {1, 1, 1e-6})};
  return s;
}

Positions swung(const Scenario& s, double T, std::int64_t* steps = nullptr) {
  Simulation run(s);
  run.advance(T);
  EXPECT_DOUBLE_EQ(run.state.t, T);
  if (steps != nullptr) *steps = run.state.counts.steps;
  return run.now().x;
}

// A fine solution of another scheme is the reference.
TEST(AdaptiveSteps, TheErrorFallsWithTheTolerance) {
  const double T = 0.03;
  Scenario fine = swinging_bar(Scheme::Dirk3, 1e-12);
  fine.integrator.step = 1e-4;
  const Positions exact = swung(fine, T);
  std::int64_t few = 0, many = 0;
  const double coarse =
      (swung(swinging_bar(Scheme::Explicit, 1e-7), T, &few) - exact).cwiseAbs().maxCoeff();
  const double tight =
      (swung(swinging_bar(Scheme::Explicit, 1e-9), T, &many) - exact).cwiseAbs().maxCoeff();
  EXPECT_LT(coarse, 2e-5);  // of a swing of 1 mm
  EXPECT_LT(tight, 1.5e-6);
  EXPECT_LT(tight, 0.2 * coarse);
  EXPECT_GT(many, few);
}

TEST(AdaptiveSteps, ABodySpinsWithItsAngularMomentum) {
  Scenario s = scene(1e-2, Scheme::Explicit);
  s.integrator.position_tolerance = 1e-8;
  s.bodies = {mass_body("body", 1, Vec3::Zero(), {1, 2, 3})};
  s.bodies[0].angular_velocity = {3, 4, 5};
  Simulation run(s);
  run.advance(0.4);
  const Mat3& R = run.now().poses[0].R;
  const Vec3 H = R * Vec3(1, 2, 3).asDiagonal() * R.transpose() * run.now().velocities[0].angular;
  EXPECT_LT((H - Vec3(3, 8, 15)).norm(), 1e-3);
  EXPECT_NEAR(run.state.y.segment<4>(run.model.layout.rigid_q(0)).norm(), 1, 1e-9);
}

// A run that goes on from a restart point, in a program of its own, is the run that passed it.
TEST(AdaptiveSteps, GoesOnFromARestartPointBitForBit) {
  Simulation whole(swinging_bar(Scheme::Explicit, 1e-7));
  whole.advance(0.01);
  const State at_restart = whole.state;
  whole.stepper.restart(whole.state);
  whole.advance(0.02);

  Simulation resumed(swinging_bar(Scheme::Explicit, 1e-7));
  resumed.state = at_restart;
  resumed.stepper.restart(resumed.state);
  resumed.advance(0.02);
  EXPECT_EQ(resumed.state.y, whole.state.y);
  EXPECT_EQ(resumed.state.counts.steps, whole.state.counts.steps);
}

TEST(AdaptiveSteps, ABlockFallsOnAFloorAndStaysAbove) {
  Scenario s = scene(1e-3, Scheme::Explicit);
  s.integrator.position_tolerance = 1e-7;
  s.contact = true;
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.01, 0.01, 0.01}, {0, 0, 0.0055}, {2, 2, 2}),
              box_body("floor", Body::Kind::Fixed, {0.04, 0.04, 0.004}, {0, 0, -0.002}, {2, 2, 1})};
  s.loads = {gravity({0, 0, -9.81})};
  Simulation run(s);
  double lowest = 1;
  run.advance(0.03, [&] { lowest = std::min(lowest, run.now().x.row(2).minCoeff()); });
  EXPECT_GT(run.state.counts.reported_pairs, 0);
  EXPECT_LT(run.now().x.row(2).minCoeff(), 5e-4);
  EXPECT_GT(lowest, -1e-4);
  // Nothing but the fall's 52 uJ is there, and little of it is lost.
  EXPECT_LT(std::abs(run.loss()), 0.1 * 1e-3 * 9.81 * 5.5e-3);
}

}  // namespace articular::sim::adaptive_test
