// Bones of which some freedoms are held: closed forms, reactions, frames.
#include "sim/model/constrained_rigid_body.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/sim/support/scenario_file.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::constrained_rigid_body_test {

using Scheme = Integrator::Scheme;

constexpr std::array<bool, 6> kHingeY = {true, true, true, true, false, true};
constexpr double kMass = 2, kLength = 0.3, kGravity = 9.81;  // pivot to centre of mass
const Vec3 kInertia(0.03, 0.05, 0.04);                       // about the centre of mass

/// A pendulum that hangs from the origin and turns about y, let go at an angle to the vertical.
Scenario pendulum(double angle, double step, Scheme scheme) {
  Scenario s = scene(step, scheme);
  s.bodies = {
      mass_body("bob", kMass, kLength * Vec3(-std::sin(angle), 0, -std::cos(angle)), kInertia)};
  s.bodies[0].hold = Hold{kHingeY, Mat3::Identity(), Vec3::Zero()};
  s.loads = {gravity({0, 0, -kGravity})};
  return s;
}

double pivot_inertia() { return kInertia.y() + kMass * kLength * kLength; }
double frequency() { return std::sqrt(kMass * kGravity * kLength / pivot_inertia()); }

/// Of a small swing after a quarter period, when its angle is 0 and its velocity -θ₀ω: both by
/// their amplitudes.
double swing_error(Scheme scheme, int steps) {
  constexpr double kSmall = 1e-3;  // its square is the error of the closed form
  const double quarter = std::numbers::pi / 2 / frequency();
  Simulation run(pendulum(kSmall, quarter / steps, scheme));
  run.advance(quarter);
  const Vec3 arm = run.now().poses[0].R * Vec3(-std::sin(kSmall), 0, -std::cos(kSmall));
  return std::hypot(arm.x() / kSmall,
                    run.now().velocities[0].angular.y() / (kSmall * frequency()) + 1);
}

TEST(HeldBone, APendulumSwingsByItsClosedFormAtTheSchemesOrder) {
  EXPECT_NEAR(
      std::log2(swing_error(Scheme::ImplicitEuler, 100) / swing_error(Scheme::ImplicitEuler, 200)),
      1, 0.1);
  EXPECT_LT(std::abs(swing_error(Scheme::TrBdf2, 100)), 1e-4);
  EXPECT_NEAR(std::log2(swing_error(Scheme::TrBdf2, 25) / swing_error(Scheme::TrBdf2, 50)), 2, 0.2);
}

// The hinge's force by the state: along the pendulum it carries weight and centripetal force,
// across it what the weight's share of angular acceleration leaves; by the bob on its hinge.
TEST(HeldBone, APendulumPullsAtItsPivotByTheClosedFormAndThePivotStays) {
  for (const Scheme scheme :
       {Scheme::ImplicitEuler, Scheme::TrBdf2, Scheme::Dirk3, Scheme::Explicit}) {
    constexpr double kStart = 1.2;
    Simulation run(pendulum(kStart, 2e-3, scheme));
    run.advance(0.5, [&] {
      const Pose& pose = run.now().poses[0];
      const Vec3 arm = pose.R * Vec3(-std::sin(kStart), 0, -std::cos(kStart));
      const double omega = run.now().velocities[0].angular.y();
      const Vec3 weight(0, 0, -kMass * kGravity);
      const Vec3 along = (weight.dot(arm) + kMass * kLength * omega * omega) * arm;
      const Vec3 across =
          (1 - kMass * kLength * kLength / pivot_inertia()) * (weight - weight.dot(arm) * arm);
      const Vec6 reaction = reaction_of(run.stepper.now(), 0);
      EXPECT_LT((reaction.head<3>() - along - across).norm(), 1e-11 * kMass * kGravity);
      EXPECT_LT(reaction.tail<3>().norm(), 1e-12);
      EXPECT_EQ(pose.p.norm(), 0);
      EXPECT_LT((pose.R * Vec3::UnitY() - Vec3::UnitY()).norm(), 1e-15);
    });
    EXPECT_LT((run.now().poses[0].R * Vec3::UnitX()).x(), 0.2);  // it has swung through
  }
}

TEST(HeldBone, EnergyOfASwingIsKept) {
  Simulation run(pendulum(1.2, 1e-3, Scheme::TrBdf2));
  double kinetic = 0;
  run.advance(0.4, [&] { kinetic = std::max(kinetic, run.stepper.stored_energy().kinetic); });
  EXPECT_GT(kinetic, 3);
  EXPECT_LT(std::abs(run.loss()), 1e-5 * kinetic);
}

/// A block that only slides along z, on a spring, pushed beside its middle.
Scenario slider(Scenario s, const Mat3& R) {
  s.bodies = {mass_body("block", 1, Vec3::Zero(), 0.01 * Vec3::Ones()), stand("wall")};
  s.bodies[0].hold = Hold{{true, true, false, true, true, true}, R, R * Vec3(0.02, 0, 0)};
  Ligament spring;
  spring.name = "spring";
  spring.path = {anchor("wall", R * Vec3(0, 0, -0.1)), anchor("block", Vec3::Zero())};
  spring.stiffness = 500;
  spring.damping = 30;
  s.ligaments = {spring};
  ForceLoad push;
  push.at = anchor("block", R * Vec3(0.01, 0.03, 0));
  push.force = R * Vec3(3, -2, 5);
  s.loads = {push};
  return s;
}

void expect_slid(const Simulation& run, const Mat3& R, double tolerance) {
  const Vec3 away = R.transpose() * run.now().poses[0].p - Vec3(0.02, 0, 0);
  EXPECT_NEAR(away.z(), 5.0 / 500, tolerance * 0.01);
  EXPECT_LT(away.head<2>().norm(), 1e-11 * tolerance / 1e-6);
  EXPECT_LT((run.now().poses[0].R - Mat3::Identity()).norm(), 1e-15);
  // The spring ends beside the held point too.
  const Vec6 reaction = reaction_of(run.stepper.now(), 0);
  const Vec3 moment =
      Vec3(-0.01, 0.03, 0).cross(Vec3(3, -2, 5)) + Vec3(-0.02, 0, 0).cross(Vec3(0, 0, -5));
  EXPECT_LT((R.transpose() * reaction.head<3>() - Vec3(3, -2, 0)).norm(), 5 * tolerance);
  EXPECT_LT((R.transpose() * reaction.tail<3>() - moment).norm(), 5 * tolerance);
}

TEST(HeldBone, ReactionEqualsTheLoadInStaticsAndInTheEndInTime) {
  const Mat3 turned = rotation_matrix({0.4, -0.7, 1.1});
  for (const Mat3& R : {Mat3::Identity().eval(), turned}) {
    Scenario still = scene(1);
    still.analysis = Scenario::Analysis::Static;
    Simulation statics(slider(still, R));
    statics.advance(1);
    expect_slid(statics, R, 1e-6);
    Simulation dynamics(slider(scene(5e-3), R));
    dynamics.advance(3);
    expect_slid(dynamics, R, 1e-6);
  }
}

/// A bar of tissue between a wall and a plate that only slides along it, pulled by a force.
Scenario bar_on_slider(TissueMaterial::Element element, double force) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.02, 0.02, 0.08}, {0, 0, 0.04}, {2, 2, 6}),
              stand("wall"), mass_body("plate", 0.1, {0.01, 0.02, 0.09}, 1e-4 * Vec3::Ones())};
  s.bodies[0].material = neo_hookean(15e3, 0.45);
  s.bodies[0].material->element = element;
  s.bodies[2].hold = Hold{{true, true, false, true, true, true}, Mat3::Identity(), {}};
  s.attachments = {attach("bar", "wall", {-1, -1, -1e-6}, {1, 1, 1e-6}),
                   attach("bar", "plate", {-1, -1, 0.0799}, {1, 1, 0.0801})};
  ForceLoad pull;
  pull.at = anchor("plate", {0.03, 0, 0.09});
  pull.force = {0.2, 0, force};
  s.loads = {pull};
  return s;
}

// What the plate puts on its hold is the load's part across its way and the load's moment; what the
// wall feels is the part along it. The bar is symmetric but for its mesh, whose moments are small.
TEST(HeldBone, TissueOnASlidingPlateCarriesTheLoadAlongItsWay) {
  for (const auto element : {TissueMaterial::Element::Plain, TissueMaterial::Element::Smoothed}) {
    constexpr double kForce = 1.5;  // a quarter of E A
    Simulation run(bar_on_slider(element, kForce));
    run.advance(1);
    const int wall = run.model.bodies[1].rigid, plate = run.model.bodies[2].rigid;
    EXPECT_NEAR(reaction_of(run.stepper.now(), wall).z(), kForce, 1e-5 * kForce);
    const Vec6 held = reaction_of(run.stepper.now(), plate);
    EXPECT_EQ(held.z(), 0);
    EXPECT_NEAR(held.x() + reaction_of(run.stepper.now(), wall).x(), 0.2, 1e-5);
    EXPECT_NEAR(run.now().poses[static_cast<std::size_t>(plate)].p.head<2>().norm(),
                run.model.rigid_bodies[static_cast<std::size_t>(plate)].rest.p.head<2>().norm(),
                1e-16);
    const auto rows = run.stepper.take_convergence();
    EXPECT_LT(rows.size(), 9U);  // Newton's method: with a wrong matrix it takes many more
  }
}

TEST(HeldBone, WhatIsLeftFreeIsNamedWhereNothingResistsIt) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {mass_body("block", 1)};
  s.bodies[0].hold = Hold{{true, true, false, true, true, true}, Mat3::Identity(), {}};
  s.loads = {gravity({0, 0, -1})};
  try {
    Simulation run(s);
    run.advance(1);
    FAIL() << "a block that nothing holds along z was found in balance";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("`block` can shift along (0.00 0.00"),
              std::string::npos)
        << error.what();
  }
}

using HeldBoneFile = ScenarioTest;

std::string with_hold(const std::string& hold) {
  std::string text = kStart;
  text.replace(text.find("mass = \"0.2 kg\""), 15, "mass = \"0.2 kg\"\n" + hold);
  return text;
}

TEST_F(HeldBoneFile, FreedomsAreReadByTheirNames) {
  const Scenario s = read(with_hold(
      "hold = { freedoms = [\"translation.y\", \"rotation.x\", \"rotation.z\"], at = \"1 2 3 mm\", "
      "turned = \"0 0 90 deg\" }"));
  ASSERT_TRUE(s.bodies[1].hold);
  EXPECT_EQ(s.bodies[1].hold->held, (std::array<bool, 6>{false, true, false, true, false, true}));
  EXPECT_LT((*s.bodies[1].hold->at - Vec3(1e-3, 2e-3, 3e-3)).norm(), 1e-15);
  EXPECT_LT((s.bodies[1].hold->axes.col(0) - Vec3::UnitY()).norm(), 1e-15);
}

TEST_F(HeldBoneFile, WhatCannotBeHeldIsRefused) {
  const auto expect = [&](const std::string& text, const std::string& words) {
    EXPECT_NE(refusal(text).find(words), std::string::npos) << refusal(text);
  };
  expect(with_hold("hold = { freedoms = [\"rotation.x\"] }"), "one rotation alone cannot be held");
  expect(with_hold("hold = { freedoms = [\"rotation.w\"] }"), "expected one of \"translation.x\"");
  expect(with_hold("hold = { freedoms = [\"translation.x\"] }\nvelocity = \"1 0 0 mm/s\""),
         "moves along a freedom that `hold` holds");
  expect(kStart + "hold = { freedoms = [\"translation.x\"] }", "a fixed body is held as a whole");
  expect(kStart + "[[probe]]\nname = \"r\"\nkind = \"reaction\"\nbody = \"mandible\"",
         "expected a fixed body or a rigid one with `hold`");
}

}  // namespace articular::sim::constrained_rigid_body_test
