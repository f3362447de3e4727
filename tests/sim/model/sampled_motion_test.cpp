// Held rigid bodies that follow a spline through samples, in time and in statics.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sim/build/build_model.hpp"
#include "sim/model/constrained_rigid_body.hpp"
#include "sim/output/fingerprint.hpp"
#include "sim/run/run.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::sampled_motion_test {

using Scheme = Integrator::Scheme;

constexpr double kMass = 2, kWay = 0.4;
const std::vector<double> kTimes = {0, 0.1, 0.15, 0.4, 0.55, 0.9, 1};

/// A cubic that rests at both ends is its own clamped spline.
double path(double t) { return t * t * (3 - 2 * t); }
double path_acceleration(double t) { return 6 - 12 * t; }

MotionLoad sampled(const std::vector<double>& times, const Vec3& way, const Vec3& turn) {
  MotionLoad load;
  load.body = "body";
  load.motion.time = times;
  for (const double t : times) {
    load.motion.translation.push_back(path(t) * way);
    load.motion.rotation.push_back(path(t) * turn);
  }
  load.motion.interpolation = Motion::Interpolation::Spline;
  return load;
}

class SampledMotion : public ::testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, SampledMotion,
                         ::testing::Values(Scheme::ImplicitEuler, Scheme::TrBdf2, Scheme::Dirk3,
                                           Scheme::Explicit));

// What holds it gives m a of the spline, and I α about an axis; along y it falls freely.
TEST_P(SampledMotion, TakesTheForceOfItsSplinesAcceleration) {
  constexpr double kTurn = 1.2, kGravity = 9.81;
  const Vec3 inertia(0.03, 0.05, 0.04);
  const Mat3 axes = rotation_matrix({0.4, -0.7, 1.1});
  Scenario s = scene(5e-3, GetParam());
  s.bodies = {mass_body("body", kMass, Vec3::Zero(), inertia)};
  s.bodies[0].inertia = (axes * inertia.asDiagonal() * axes.transpose()).eval();
  s.bodies[0].hold = Hold{{true, false, true, true, true, true}, axes, Vec3::Zero()};
  s.loads = {gravity(axes * Vec3(0, -kGravity, 0)),
             sampled(kTimes, {kWay, 0, -kWay}, {0, 0, kTurn})};
  Simulation run(s);
  run.advance(0.8, [&] {
    const double t = run.state.t;
    const Vec3 p = axes.transpose() * run.now().poses[0].p;
    EXPECT_NEAR(p.x(), kWay * path(t), 1e-14);
    EXPECT_NEAR((axes.transpose() * run.now().velocities[0].linear).y(), -kGravity * t, 1e-6);
    const Vec6 reaction = reaction_of(run.stepper.now(), 0);
    const double a = path_acceleration(t);
    const Vec3 force = axes.transpose() * reaction.head<3>(),
               moment = axes.transpose() * reaction.tail<3>();
    EXPECT_LT((force - kMass * kWay * a * Vec3(-1, 0, 1)).norm(), 1e-10) << t;
    EXPECT_LT((moment - Vec3(0, 0, -inertia.z() * kTurn * a)).norm(), 1e-11) << t;
  });
}

// The work of the drive is the kinetic energy, by the trapezoidal rule.
TEST(SampledMotionOf, AHeldBodyGivesItItsKineticEnergy) {
  const auto missing = [](double step) {
    Scenario s = scene(step, Scheme::TrBdf2);
    s.bodies = {mass_body("body", kMass)};
    s.bodies[0].hold = Hold{{true, true, true, true, true, true}, Mat3::Identity(), Vec3::Zero()};
    s.loads = {sampled(kTimes, {kWay, 0, 0}, Vec3::Zero())};
    Simulation run(s);
    run.advance(0.5);
    EXPECT_GT(run.stepper.stored_energy().kinetic, 0.3);
    return std::abs(run.loss());
  };
  EXPECT_LT(missing(1e-2), 1e-3);
  EXPECT_LT(missing(5e-3), 0.3 * missing(1e-2));
}

// Steps end where accelerations jump, which is at both ends of the recording alone.
TEST(SampledMotionOf, ManySamplesDoesNotShortenSteps) {
  std::vector<double> times;
  for (int i = 0; i <= 4000; ++i) times.push_back(0.1 + 0.7 * i / 4000.0);
  Scenario s = scene(0.05, Scheme::TrBdf2);
  s.bodies = {mass_body("body", kMass)};
  s.bodies[0].hold = Hold{{true, true, true, true, true, true}, Mat3::Identity(), Vec3::Zero()};
  MotionLoad load = sampled(times, {kWay, 0, 0}, Vec3::Zero());
  for (Vec3& shift : load.motion.translation) shift.x() -= kWay * path(0.1);
  s.loads = {load};
  Simulation run(s);
  EXPECT_EQ(kink_times(run.model, 1), (std::vector<double>{times.front(), times.back()}));
  run.advance(1);
  EXPECT_EQ(run.state.counts.steps, 20);
}

// The samples of a file are no text of the scenario: a checkpoint knows them all the same.
TEST(SampledMotionOf, AnotherRecordingIsAnotherScenario) {
  Scenario s = scene(0.05);
  s.bodies = {mass_body("body", kMass)};
  s.bodies[0].hold = Hold{{true, true, true, true, true, true}, Mat3::Identity(), Vec3::Zero()};
  s.loads = {sampled(kTimes, {kWay, 0, 0}, Vec3::Zero())};
  const std::string first = fingerprint(s, build_model(s));
  EXPECT_EQ(fingerprint(s, build_model(s)), first);
  std::get<MotionLoad>(s.loads[0]).motion.translation[2].z() = 1e-9;
  EXPECT_NE(fingerprint(s, build_model(s)), first);
}

// In equilibrium a held body follows the spline too, and a fixed one in time.
TEST(SampledMotionOf, ABodyInStaticsAndAFixedOneFollowIt) {
  Scenario s = scene(0.25);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {mass_body("body", kMass)};
  s.bodies[0].hold = Hold{{true, true, true, true, true, true}, Mat3::Identity(), Vec3::Zero()};
  s.loads = {sampled(kTimes, {kWay, 0, 0}, {0, 0, 0.5})};
  Simulation held(s);
  held.advance(0.75);
  EXPECT_NEAR(held.now().poses[0].p.x(), kWay * path(0.75), 1e-14);
  EXPECT_LT(reaction_of(held.stepper.now(), 0).norm(), 1e-12);

  Scenario in_time = scene(1e-2);
  in_time.bodies = {stand("body")};
  in_time.loads = s.loads;
  Simulation fixed(in_time);
  fixed.advance(0.6);
  EXPECT_NEAR(fixed.now().poses[0].p.x(), kWay * path(0.6), 1e-14);
}

}  // namespace articular::sim::sampled_motion_test
