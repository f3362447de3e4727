// Blocks on a table that stick, slide, stop and bounce, by friction and damping.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_sliding_test {

constexpr double kGravity = 9.81;  // [m/s²]
constexpr double kFriction = 0.3;  // 16.7 degrees
constexpr double kSlip = 1e-4;     // [m/s]
constexpr double kWidth = 0.02;    // of the blocks [m]
constexpr double kHeight = 0.01;   // of the blocks [m]
constexpr double kDegree = std::numbers::pi / 180;

/// A block at rest on a table; gravity is turned as if the table were an incline that falls to +x.
Scenario incline(Body::Kind kind, double angle, double step) {
  Scenario s = contact_scene(step);
  s.bodies = {box_body("table", Body::Kind::Fixed, {0.1, 0.04, 0.01}, {0.02, 0, -0.005}, {7, 3, 1}),
              box_body("block", kind, {kWidth, kWidth, kHeight}, {0, 0, 0.5 * kHeight}, {4, 4, 2})};
  if (kind == Body::Kind::Tissue) {
    s.bodies[1].material = neo_hookean(100e3, 0.3);
    s.bodies[1].material->stiffness_damping = 1e-3;
  }
  s.contacts = {{"block", "table", {}}};
  s.integrator.position_tolerance = 1e-9;
  s.contacts[0].friction = kFriction;
  s.contacts[0].slip_velocity = kSlip;
  s.loads = {gravity(kGravity * Vec3(std::sin(angle), 0, -std::cos(angle)))};
  return s;
}

/// Of two bones the default presses them 1e-14 m into each other, beyond any tolerance.
ModelChange contact_of(Body::Kind kind) {
  return kind == Body::Kind::Rigid ? contact_stiffness_of(1e9) : ModelChange{};
}

double mass() { return 1000 * kWidth * kWidth * kHeight; }

/// Mean velocity of the block down the incline [m/s].
double speed(const Simulation& run) {
  if (run.model.tissues.empty()) return run.now().velocities[0].linear.x();
  return momentum(run).x() / mass();
}

class Incline : public testing::TestWithParam<Body::Kind> {};

TEST_P(Incline, BelowTheAngleOfFrictionTheBlockCreepsAndNoMore) {
  const double angle = 10 * kDegree;
  Simulation run(incline(GetParam(), angle, 1e-3), contact_of(GetParam()));
  run.advance(0.2);
  const double ratio = std::tan(angle) / kFriction;
  const double creep = kSlip * ratio / std::sqrt(1 - ratio * ratio);
  EXPECT_NEAR(speed(run), creep, 0.02 * creep);
  const Vec3 force = run.stepper.dynamics().contact_summary(0).force;  // on the block
  const double weight = mass() * kGravity;
  EXPECT_NEAR(-force.x(), weight * std::sin(angle), 2e-3 * weight);
  EXPECT_NEAR(force.z(), weight * std::cos(angle), 2e-3 * weight);
  EXPECT_EQ(run.state.counts.rejected_newton, 0);
}

TEST_P(Incline, AboveItTheBlockSlidesWithTheAccelerationThatFrictionLeaves) {
  const double angle = 30 * kDegree;
  Simulation run(incline(GetParam(), angle, 1e-3), contact_of(GetParam()));
  run.advance(0.05);
  const double before = speed(run);
  run.advance(0.15);
  const double expected = kGravity * (std::sin(angle) - kFriction * std::cos(angle));
  EXPECT_NEAR((speed(run) - before) / 0.1, expected, 0.01 * expected);
  const Vec3 force = run.stepper.dynamics().contact_summary(0).force;
  EXPECT_NEAR(-force.x() / force.z(), kFriction, 1e-3 * kFriction);
  EXPECT_LE(run.state.counts.rejected_newton, 2);
}

// Implicit Euler makes the way shorter by half a step at the first speed, h v/2.
TEST_P(Incline, OnTheLevelABlockStopsAfterItsBrakingDistanceAndFrictionTakesItsEnergy) {
  const double v = 0.3, h = 5e-4;
  Scenario s = incline(GetParam(), 0, h);
  s.bodies[1].velocity = {v, 0, 0};
  Simulation run(s, contact_of(GetParam()));
  double distance = 0;
  run.advance(0.15, [&] { distance += h * speed(run); });
  const double expected = v * v / (2 * kFriction * kGravity);
  EXPECT_NEAR(distance, expected - 0.5 * h * v, 0.01 * expected);
  EXPECT_LT(std::abs(speed(run)), kSlip);
  const double energy = 0.5 * mass() * v * v;
  EXPECT_NEAR(run.state.energy.contact_loss, energy, 0.01 * energy);
  EXPECT_LT(std::abs(run.loss()), 0.01 * energy);
}

INSTANTIATE_TEST_SUITE_P(Contact, Incline, testing::Values(Body::Kind::Rigid, Body::Kind::Tissue),
                         [](const auto& info) {
                           return info.param == Body::Kind::Rigid ? "Rigid" : "Tissue";
                         });

TEST(Friction, WithTheDefaultSlipVelocityABlockCreepsByAFewHundredthsOfAnElement) {
  Scenario s = incline(Body::Kind::Tissue, 10 * kDegree, 1e-3);
  s.duration = 0.2;
  s.contacts[0].slip_velocity.reset();
  Simulation run(s);
  double distance = 0, before = 0;
  run.advance(0.2, [&] {
    distance += (run.state.t - before) * speed(run);
    before = run.state.t;
  });
  EXPECT_GT(distance, 0);
  EXPECT_LT(distance, 0.06 * kWidth / 4);
}

// Nothing but the end of a scene depends on its duration.
TEST(Friction, TheFirstStepsAreTheSameHoweverLongTheSceneIs) {
  const auto after_steps = [](double duration) {
    Scenario s = incline(Body::Kind::Tissue, 10 * kDegree, 1e-3);
    s.contacts[0].slip_velocity.reset();
    s.integrator.position_tolerance.reset();
    s.duration = duration;
    Simulation run(s);
    run.advance(5e-3);
    return run.state.y;
  };
  const Eigen::VectorXd expected = after_steps(0.1);
  for (const double duration : {10.0, 1e3, 1e5}) EXPECT_EQ(after_steps(duration), expected);
}

// Of steps a hundred times shorter, too: a finer step must not slip more.
TEST(Friction, TheDefaultSlipVelocityIsOfTheMeshAndGrowsShorterWithLongSteps) {
  const auto slip = [](double step) {
    Scenario s = incline(Body::Kind::Tissue, 0, step);
    s.contacts[0].slip_velocity.reset();
    return Simulation(s).model.contacts[0].law.slip_velocity;
  };
  EXPECT_EQ(slip(1e-5), slip(1e-3));
  EXPECT_NEAR(slip(1), 1e-3 * slip(1e-3), 1e-18);
}

// A table that is driven sideways takes the block along, and then leaves it behind.
TEST(Friction, ADrivenTableTakesABlockAlongAsFarAsFrictionCan) {
  for (const double acceleration : {0.5 * kFriction * kGravity, 2 * kFriction * kGravity}) {
    Scenario s = incline(Body::Kind::Rigid, 0, 1e-3);
    MotionLoad load = shift("table", 0.1, Vec3::Zero());
    load.motion.time.clear();
    load.motion.translation.clear();
    for (int k = 0; k <= 110; ++k) {  // straight pieces of a parabola
      load.motion.time.push_back(1e-3 * k);
      load.motion.translation.push_back({0.5e-6 * acceleration * k * k, 0, 0});
    }
    s.loads.push_back(load);
    Simulation run(s, contact_of(Body::Kind::Rigid));
    run.advance(0.1);
    const double expected = 0.1 * std::min(acceleration, kFriction * kGravity);
    EXPECT_NEAR(speed(run), expected, 0.02 * expected);
  }
}

TEST(Friction, OfZeroChangesNoBitAndLosesNothing) {
  Scenario with = incline(Body::Kind::Tissue, 10 * kDegree, 1e-3);
  with.contacts[0].friction = 0;
  Scenario without = with;
  without.contacts[0] = {"block", "table", {}};
  Simulation a(with), b(without);
  a.advance(0.02);
  b.advance(0.02);
  EXPECT_TRUE(a.state.y == b.state.y);
  EXPECT_EQ(a.state.energy.contact_loss, 0);
  EXPECT_NEAR(speed(a), 0.02 * kGravity * std::sin(10 * kDegree), 1e-6);
}

// --- bouncing

struct Bounce {
  double restitution, least_force, loss, numerical;  // forces [N], parts of the energy
};

/// A rigid block that falls flat onto a table with a stiffness of 1e7 Pa/m.
Bounce bounce(double damping) {
  Scenario s = contact_scene(2e-5, Integrator::Scheme::TrBdf2);
  s.integrator.position_tolerance = 1e-10;
  s.bodies = {box_body("table", Body::Kind::Fixed, {0.04, 0.04, 0.01}, {0, 0, -0.005}, {2, 2, 1}),
              box_body("block", Body::Kind::Rigid, {kWidth, kWidth, kHeight},
                       {0, 0, 0.5 * kHeight + 1e-5}, {2, 2, 1})};
  const double v = 0.1;
  s.bodies[1].velocity = {0, 0, -v};
  s.contacts = {{"block", "table", {}}};
  s.contacts[0].damping = damping;
  Simulation run(s, contact_stiffness_of(1e7));
  Bounce result{0, std::numeric_limits<double>::infinity(), 0, 0};
  run.advance(8e-3, [&] {
    result.least_force =
        std::min(result.least_force, run.stepper.dynamics().contact_summary(0).force.z());
  });
  const double energy = 0.5 * mass() * v * v;
  result.restitution = run.now().velocities[0].linear.z() / v;
  result.loss = run.state.energy.contact_loss / energy;
  result.numerical = run.loss() / energy;
  return result;
}

/// The same of a mass on one spring, by small steps: x is how deep it is.
double restitution_of_a_mass(double damping) {
  const double m = mass() / (kWidth * kWidth), k = 1e7, h = 1e-7;
  double x = 0, v = 0.1;
  do {
    const double spring = k * x;
    v -= h / m * (spring + std::clamp(damping * v, -spring, spring));
    x += h * v;
  } while (x > 0);
  return -v / 0.1;
}

// Weakly damped, e = exp(−πζ/√(1 − ζ²)).
TEST(ContactDamping, RestitutionFallsWithItAndNothingSticks) {
  const double critical = 2 * std::sqrt(1e7 * mass() / (kWidth * kWidth));  // [Pa s/m]
  EXPECT_NEAR(bounce(0).restitution, 1, 0.01);
  EXPECT_NEAR(bounce(0.02 * critical).restitution, std::exp(-std::numbers::pi * 0.02), 0.01);
  double last = 1;
  for (const double zeta : {0.05, 0.2, 0.5, 2.0}) {
    const Bounce result = bounce(zeta * critical);
    EXPECT_NEAR(result.restitution, restitution_of_a_mass(zeta * critical), 0.01) << zeta;
    EXPECT_LT(result.restitution, last - 0.05);
    EXPECT_GE(result.least_force, 0);
    EXPECT_NEAR(result.loss, 1 - result.restitution * result.restitution, 0.02);
    EXPECT_LT(std::abs(result.numerical), 0.02);
    last = result.restitution;
  }
}

}  // namespace articular::sim::contact_sliding_test
