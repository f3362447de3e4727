// Held freedoms that are driven: closed forms, reactions, energy, frames, input.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "sim/build/build_model.hpp"
#include "sim/model/constrained_rigid_body.hpp"
#include "sim/run/run.hpp"
#include "tests/sim/support/scenario_file.hpp"
#include "tests/sim/support/scene.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::driven_rigid_body_test {

using Scheme = Integrator::Scheme;

constexpr std::array<bool, 6> kAll = {true, true, true, true, true, true};

Scenario statics() {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  return s;
}

/// Along and about the axes of a hold, from 0 to the values given, in 1 s.
MotionLoad drive(const std::string& body, const Vec3& shift, const Vec3& turn) {
  MotionLoad load;
  load.body = body;
  load.motion.time = {0, 1};
  load.motion.translation = {Vec3::Zero(), shift};
  load.motion.rotation = {Vec3::Zero(), turn};
  return load;
}

/// From 0 to 1 in 1 s, at rest at both ends, and its derivatives.
double path(double t) { return t * t * (3 - 2 * t); }
double path_rate(double t) { return 6 * t * (1 - t); }
double path_acceleration(double t) { return 6 - 12 * t; }

class DrivenBoneInTime : public ::testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, DrivenBoneInTime,
                         ::testing::Values(Scheme::ImplicitEuler, Scheme::TrBdf2, Scheme::Dirk3,
                                           Scheme::Explicit));

TEST_P(DrivenBoneInTime, OneThatIsDrivenAlongXFallsFreelyAlongZ) {
  constexpr double kMass = 2, kWay = 0.4, kGravity = 9.81;
  const Vec3 center(0.1, -0.05, 0.2);  // from the held point
  for (const Mat3& axes : {Mat3::Identity().eval(), rotation_matrix({0.4, -0.7, 1.1})}) {
    Scenario s = scene(5e-3, GetParam());
    s.bodies = {mass_body("body", kMass, axes * center)};
    s.bodies[0].hold = Hold{{true, true, false, true, true, true}, axes, Vec3::Zero()};
    s.loads = {gravity(axes * Vec3(0, 0, -kGravity)), drive("body", {kWay, 0, 0}, Vec3::Zero())};
    Simulation run(s);
    run.advance(0.8, [&] {
      const Vec3 p = axes.transpose() * run.now().poses[0].p;
      const Vec3 v = axes.transpose() * run.now().velocities[0].linear;
      const double t = run.state.t;
      EXPECT_NEAR(p.x(), kWay * path(t), 1e-14);
      EXPECT_NEAR(v.x(), kWay * path_rate(t), 1e-13);
      EXPECT_NEAR(p.y(), 0, 1e-14);
      EXPECT_NEAR(v.z(), -kGravity * t, 1e-6);
      // What drives it gives m a at the centre of mass, which is off the held point.
      const Vec3 force(-kMass * kWay * path_acceleration(t), 0, 0);
      const Vec6 reaction = reaction_of(run.stepper.now(), 0);
      EXPECT_LT((axes.transpose() * reaction.head<3>() - force).norm(), 1e-11);
      EXPECT_LT((axes.transpose() * reaction.tail<3>() - center.cross(force)).norm(), 1e-11);
    });
    EXPECT_NEAR(axes.col(2).dot(run.now().poses[0].p), -0.5 * kGravity * 0.64,
                GetParam() == Scheme::ImplicitEuler ? 0.02 : 1e-4);
  }
}

constexpr double kBobMass = 2, kLength = 0.3, kInertia = 0.05, kPivotWay = 0.5;

/// A pendulum at rest whose pivot is driven along x. Of its angle φ, and of m² L² by I_p:
/// I_p φ̈ = m L a cos φ − m g L sin φ, the bob at (−sin φ, 0, −cos φ) L from the pivot.
struct Swing {
  double phi = 0, rate = 0;
};

constexpr double kGravity = 9.81;

double swing_acceleration(double t, double phi) {
  const double pivot_inertia = kInertia + kBobMass * kLength * kLength;
  return kBobMass * kLength *
         (kPivotWay * path_acceleration(t) * std::cos(phi) - kGravity * std::sin(phi)) /
         pivot_inertia;
}

/// By the classical scheme of fourth order in small steps.
Swing swing_at(double end) {
  constexpr int kSteps = 2000;
  const double h = end / kSteps;
  Swing s;
  for (int i = 0; i < kSteps; ++i) {
    const double t = i * h;
    const double a1 = swing_acceleration(t, s.phi);
    const double a2 = swing_acceleration(t + h / 2, s.phi + h / 2 * s.rate);
    const double a3 = swing_acceleration(t + h / 2, s.phi + h / 2 * (s.rate + h / 2 * a1));
    const double a4 = swing_acceleration(t + h, s.phi + h * (s.rate + h / 2 * a2));
    s.phi += h * s.rate + h * h / 6 * (a1 + a2 + a3);
    s.rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return s;
}

Scenario driven_pendulum(double step, Scheme scheme) {
  Scenario s = scene(step, scheme);
  s.bodies = {mass_body("bob", kBobMass, {0, 0, -kLength}, {0.03, kInertia, 0.04})};
  s.bodies[0].hold =
      Hold{{true, true, true, true, false, true}, Mat3::Identity(), Vec3::Zero().eval()};
  s.loads = {gravity({0, 0, -kGravity}), drive("bob", {kPivotWay, 0, 0}, Vec3::Zero())};
  return s;
}

double swing_error(double step, Scheme scheme) {
  constexpr double kEnd = 0.8;
  Simulation run(driven_pendulum(step, scheme));
  run.advance(kEnd);
  const Vec3 arm = run.now().poses[0].R * Vec3(0, 0, -1);
  const Swing exact = swing_at(kEnd);
  return std::hypot(std::atan2(-arm.x(), -arm.z()) - exact.phi,
                    run.now().velocities[0].angular.y() - exact.rate);
}

TEST(DrivenBone, APendulumOnADrivenPivotSwingsByItsEquationAtTheSchemesOrder) {
  EXPECT_GT(std::abs(swing_at(0.8).phi), 0.05);
  EXPECT_LT(swing_error(2e-3, Scheme::ImplicitEuler), 0.05);
  EXPECT_NEAR(std::log2(swing_error(4e-3, Scheme::ImplicitEuler) /
                        swing_error(2e-3, Scheme::ImplicitEuler)),
              1, 0.1);
  EXPECT_LT(swing_error(4e-3, Scheme::Dirk3), 1e-4);
  EXPECT_LT(swing_error(4e-3, Scheme::TrBdf2), 1e-3);
}

// The pivot's force by the state: m (a − g) of the bob, and the moment is none.
TEST_P(DrivenBoneInTime, APendulumPullsAtItsDrivenPivotAsItsBobIsAccelerated) {
  Simulation run(driven_pendulum(2e-3, GetParam()));
  run.advance(0.7, [&] {
    const double t = run.state.t, omega = run.now().velocities[0].angular.y();
    const Vec3 arm = kLength * (run.now().poses[0].R * Vec3(0, 0, -1));
    const double alpha = swing_acceleration(t, std::atan2(-arm.x(), -arm.z()));
    const Vec3 acceleration = Vec3(kPivotWay * path_acceleration(t), 0, 0) +
                              alpha * Vec3::UnitY().cross(arm) - omega * omega * arm;
    const Vec6 reaction = reaction_of(run.stepper.now(), 0);
    EXPECT_LT((reaction.head<3>() - kBobMass * (Vec3(0, 0, -kGravity) - acceleration)).norm(),
              1e-9);
    EXPECT_LT(reaction.tail<3>().norm(), 1e-9);
  });
  EXPECT_NEAR(run.now().poses[0].p.x(), kPivotWay * path(0.7), 1e-15);
}

TEST(DrivenBone, TheDrivesWorkIsWhatAPendulumGains) {
  const auto lost = [](double step) {
    Simulation run(driven_pendulum(step, Scheme::TrBdf2));
    run.advance(0.5);
    EXPECT_GT(run.state.energy.motion_work, 0.3);  // of 0.56 J in the bob's shift alone
    return run.loss();
  };
  EXPECT_LT(std::abs(lost(2e-3)), 1e-4);
  EXPECT_LT(std::abs(lost(1e-3)), 0.3 * std::abs(lost(2e-3)));
}

/// A body without weight that is turned about its own z and free to turn about the y of space.
Mat3 uneven_inertia() {
  Mat3 inertia;
  inertia << 0.05, 0.008, 0.012, 0.008, 0.04, -0.015, 0.012, -0.015, 0.06;
  return inertia;
}

Scenario gimbal(double step, Scheme scheme, double angle) {
  Scenario s = scene(step, scheme);
  s.bodies = {mass_body("rotor", 1)};
  s.bodies[0].inertia = uneven_inertia();
  s.bodies[0].hold = Hold{{true, true, true, true, false, true}, Mat3::Identity(), {}};
  s.loads = {drive("rotor", Vec3::Zero(), {0, 0, angle})};
  return s;
}

/// ω of the body in its own frame is θ̇ z + φ̇ u, u = R_z(θ)ᵀ y, and nothing changes the momentum
/// u·I ω of the free turn φ: dφ/dθ = −(u·I z)/(u·I u) whatever the turn's course in time.
double free_turn_per_turn(double theta) {
  const Vec3 u = rotation_matrix({0, 0, -theta}) * Vec3::UnitY();
  return -u.dot(uneven_inertia() * Vec3::UnitZ()) / u.dot(uneven_inertia() * u);
}

double free_turn(double theta) {  // by Simpson's rule
  constexpr int kParts = 400;
  const double h = theta / kParts;
  double sum = 0;
  for (int i = 0; i < kParts; ++i)
    sum += h / 6 *
           (free_turn_per_turn(i * h) + 4 * free_turn_per_turn((i + 0.5) * h) +
            free_turn_per_turn((i + 1) * h));
  return sum;
}

double gimbal_error(double step, Scheme scheme) {
  constexpr double kAngle = 2;
  Simulation run(gimbal(step, scheme, kAngle));
  run.advance(0.6);
  const double theta = kAngle * path(0.6);
  const Mat3 expected = rotation_matrix({0, free_turn(theta), 0}) * rotation_matrix({0, 0, theta});
  return (run.now().poses[0].R - expected).norm();
}

TEST(DrivenBone, AFreeTurnFollowsADrivenOneByItsMomentum) {
  EXPECT_GT(std::abs(free_turn(1.3)), 0.1);
  EXPECT_LT(gimbal_error(5e-3, Scheme::ImplicitEuler), 0.02);
  EXPECT_LT(gimbal_error(5e-3, Scheme::Dirk3), 2e-5);
  EXPECT_NEAR(std::log2(gimbal_error(4e-3, Scheme::TrBdf2) / gimbal_error(2e-3, Scheme::TrBdf2)), 2,
              0.3);
}

TEST(DrivenBone, TheDrivesWorkIsWhatARotorGains) {
  const auto run_half = [](double step) {
    Simulation run(gimbal(step, Scheme::TrBdf2, 2));
    run.advance(0.5);
    EXPECT_GT(run.state.energy.motion_work, 0.1);
    return std::abs(run.loss());
  };
  EXPECT_LT(run_half(2e-3), 2e-5);
  EXPECT_LT(run_half(1e-3), 0.3 * run_half(2e-3));
}

// Several driven turns are one rotation vector; the moment is that of L = R I Rᵀ ω, by differences.
TEST(DrivenBone, TurnsDrivenTogetherAreARotationVectorAndTheirMomentThatOfAngularMomentum) {
  const Vec3 turn(0.9, -0.5, 0.7);
  Scenario s = scene(0.01);
  s.bodies = {mass_body("body", 1)};
  s.bodies[0].inertia = uneven_inertia();
  s.bodies[0].hold = Hold{kAll, Mat3::Identity(), {}};
  MotionLoad load = drive("body", Vec3::Zero(), turn);
  load.motion.time = {0, 1, 1.5};
  load.motion.translation.clear();
  load.motion.rotation.push_back({-0.3, 0.4, 1.2});
  s.loads = {load};
  Simulation run(s);
  const auto momentum = [&](double t) {
    const Mat3 R = driven_pose(load.motion, Pose{}, t).R;
    return Vec3(R * uneven_inertia() * R.transpose() *
                driven_velocity(load.motion, Pose{}, t).angular);
  };
  run.advance(1.3, [&] {
    constexpr double h = 1e-5;
    const double t = run.state.t;
    EXPECT_LT((run.now().poses[0].R - driven_pose(load.motion, Pose{}, t).R).norm(), 1e-15);
    if (t <= 1) {
      EXPECT_LT((run.now().poses[0].R - rotation_matrix(path(t) * turn)).norm(), 1e-14);
    }
    if (std::abs(t - 1) < 1e-3) return;  // the acceleration jumps
    const Vec3 rate = (momentum(t + h) - momentum(t - h)) / (2 * h);
    EXPECT_LT((reaction_of(run.stepper.now(), 0).tail<3>() + rate).norm(),
              1e-8 + 1e-7 * rate.norm())
        << t;
  });
}

/// A body on the x axis, turned about x, with a spring from its rim to a stand.
Scenario sprung_wheel(Scenario s) {
  s.bodies = {mass_body("wheel", 1, Vec3::Zero(), {0.02, 0.03, 0.03}), stand("stand")};
  s.bodies[0].hold = Hold{kAll, Mat3::Identity(), Vec3::Zero().eval()};
  Ligament spring;
  spring.name = "spring";
  spring.path = {anchor("stand", {0, 0.3, 0}), anchor("wheel", {0, 0.1, 0})};
  spring.stiffness = 700;
  spring.slack_length = 0.15;
  s.ligaments = {spring};
  s.loads = {drive("wheel", Vec3::Zero(), {1.5, 0, 0})};
  return s;
}

void expect_spring_and_inertia(const Simulation& run, double inertia) {
  const double t = run.state.t, angle = 1.5 * path(t);
  const Vec3 rim = 0.1 * Vec3(0, std::cos(angle), std::sin(angle));
  const Vec3 way = Vec3(0, 0.3, 0) - rim;
  const Vec3 pull = 700 * (way.norm() - 0.15) * way.normalized();
  const Vec6 reaction = reaction_of(run.stepper.now(), 0);
  EXPECT_LT((reaction.head<3>() - pull).norm(), 1e-10);
  const Vec3 inertial(inertia * 1.5 * path_acceleration(t), 0, 0);
  EXPECT_LT((reaction.tail<3>() - rim.cross(pull) + inertial).norm(), 1e-10);
}

TEST(DrivenBone, AWheelTurnedAgainstASpringPutsItsPullAndItsInertiaOnWhatTurnsIt) {
  Simulation in_time(sprung_wheel(scene(0.02)));
  in_time.advance(0.98, [&] { expect_spring_and_inertia(in_time, 0.02); });
  Scenario slow = sprung_wheel(statics());
  slow.integrator.step = 0.02;
  Simulation still(slow);
  still.advance(0.98, [&] { expect_spring_and_inertia(still, 0); });
  // The drive's work is what the spring stores, by the trapezoidal rule's error.
  const double stored = still.stepper.stored_energy().lines - 0.5 * 700 * 0.05 * 0.05;
  EXPECT_GT(stored, 1);
  EXPECT_NEAR(still.state.energy.motion_work, stored, 2e-3 * stored);
  EXPECT_NEAR(in_time.state.energy.motion_work,
              stored + 0.5 * 0.02 * std::pow(1.5 * path_rate(0.98), 2), 2e-3 * stored);
}

TEST(DrivenBone, ALigamentDrawnOutByADrivenShiftFindsItsLineInStatics) {
  Scenario s = statics();
  s.integrator.step = 0.1;
  s.bodies = {mass_body("block", 1, {0.1, 0.02, -0.03}), stand("wall")};
  s.bodies[0].hold = Hold{{true, false, false, true, true, true}, Mat3::Identity(), {}};
  Ligament band;
  band.name = "band";
  band.path = {anchor("wall", Vec3::Zero()), anchor("block", {0.1, 0.02, -0.03})};
  band.stiffness = 400;
  band.slack_length = 0.05;
  s.ligaments = {band};
  s.loads = {drive("block", {0.06, 0, 0}, Vec3::Zero())};
  Simulation run(s);
  run.advance(1, [&] {
    const double x = 0.1 + 0.06 * path(run.state.t);
    EXPECT_LT((run.now().poses[0].p - Vec3(x, 0, 0)).norm(), 1e-7);
    EXPECT_LT((reaction_of(run.stepper.now(), 0).head<3>() - Vec3(-400 * (x - 0.05), 0, 0)).norm(),
              1e-4);
  });
}

/// A bar of tissue that grows on a plate below, with its upper end free or on a wall.
Scenario bar_on(Body plate, const Load& load, bool on_wall, Scenario s) {
  plate.name = "plate";
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.02, 0.02, 0.08}, {0, 0, 0.04}, {2, 2, 6}),
              std::move(plate), stand("wall")};
  s.attachments = {attach("bar", "plate", {-1, -1, -1e-6}, {1, 1, 1e-6})};
  if (on_wall) s.attachments.push_back(attach("bar", "wall", {-1, -1, 0.0799}, {1, 1, 0.0801}));
  s.loads = {load};
  return s;
}

Body held_plate(std::array<bool, 6> held, double mass = 0.1) {
  Body plate = mass_body("plate", mass, {0, 0, -0.01}, 1e-3 * mass * Vec3::Ones());
  plate.hold = Hold{held, Mat3::Identity(), Vec3(0, 0, -0.01)};
  return plate;
}

// One load step of 60 degrees: nodes that grow on a driven bone alone go with it.
TEST(DrivenBone, TissueOnATurningBoneTurnsWithItUnstrained) {
  Simulation run(
      bar_on(held_plate(kAll), drive("plate", {0.01, 0, 0}, {1.05, 0, 0}), false, statics()));
  run.advance(1);
  EXPECT_EQ(run.state.counts.rejected_newton, 0);
  EXPECT_LT(run.stepper.stored_energy().elastic, 1e-15);
  const Tissue& bar = run.model.tissues[0];
  const Vec3 center(0, 0, -0.01);
  for (std::size_t i = 0; i < bar.nodes.size(); ++i) {
    const Vec3 expected =
        center + Vec3(0.01, 0, 0) +
        rotation_matrix({1.05, 0, 0}) * (bar.X.col(static_cast<Eigen::Index>(i)) - center);
    EXPECT_LT((run.now().position(bar.nodes[i]) - expected).norm(), 1e-9);
  }
}

// All freedoms held and driven: the fixed body with the same motion, whose tissue moves alike. It
// has no mass of its own, so the rigid one has next to none.
TEST(DrivenBone, HeldAsAWholeItIsABodyWhoseMotionIsPrescribed) {
  const MotionLoad held_drive = drive("plate", {0.004, 0, -0.01}, {0, 0.5, 0.3});
  MotionLoad motion = held_drive;
  motion.motion.about = {0, 0, -0.01};
  Scenario in_time = scene(0.005);
  Scenario still = statics();
  still.integrator.step = 0.25;
  for (const Scenario& s : {in_time, still}) {
    const bool is_static = s.analysis == Scenario::Analysis::Static;
    const Body fixed = box_body("plate", Body::Kind::Fixed, {0.02, 0.02, 0.004}, {0, 0, -0.01});
    Simulation one(bar_on(held_plate(kAll, 1e-8), held_drive, true, s));
    Simulation other(bar_on(fixed, motion, true, s));
    const double end = is_static ? 0.5 : 0.3;  // in the middle nothing is accelerated
    one.advance(end);
    other.advance(end);
    Positions x, y;
    positions_of(one.now(), one.model.tissues[0].nodes, x);
    positions_of(other.now(), other.model.tissues[0].nodes, y);
    EXPECT_LT((x - y).cwiseAbs().maxCoeff(), 2e-8);
    // The held point is the middle of the other's box.
    const Vec6 held = reaction_of(one.stepper.now(), one.model.bodies[1].rigid);
    const Vec6 driven = reaction_of(other.stepper.now(), other.model.bodies[1].rigid);
    EXPECT_GT(held.head<3>().norm(), 0.1);
    EXPECT_LT((held.head<3>() - driven.head<3>()).norm(), 1e-4 * held.head<3>().norm());
    EXPECT_LT((held.tail<3>() - driven.tail<3>()).norm(), 1e-4 * held.tail<3>().norm());
    EXPECT_NEAR(one.state.energy.motion_work, other.state.energy.motion_work,
                (is_static ? 1e-4 : 1e-3) * one.state.energy.motion_work);
    const double moving = kinetic_energy(one.stepper.now());
    EXPECT_NEAR(kinetic_energy(other.stepper.now()), moving, 1e-4 * moving);
  }
}

// What is driven in statics is where its path is; what is free balances the tissue between.
TEST(DrivenBone, WhatADrivenPlateLeavesFreeIsInBalance) {
  Scenario s = statics();
  s.integrator.step = 0.25;
  Simulation run(bar_on(held_plate({false, false, true, false, true, true}),
                        drive("plate", {0, 0, -0.008}, {0, 0.4, 0}), true, s));
  run.advance(1);
  const int plate = run.model.bodies[1].rigid;
  const Pose& pose = run.now().poses[static_cast<std::size_t>(plate)];
  EXPECT_NEAR(pose.p.z(), -0.018, 1e-16);
  EXPECT_GT(pose.p.head<2>().norm(), 1e-4);
  // Its turn is a free one about x after the driven one about y.
  const Mat3 free = pose.R * rotation_matrix({0, -0.4, 0});
  EXPECT_LT((free.col(0) - Vec3::UnitX()).norm(), 1e-12);
  const Vec6 reaction = reaction_of(run.stepper.now(), plate);
  EXPECT_EQ(reaction.head<2>().norm(), 0);
  EXPECT_EQ(reaction[3], 0);
  EXPECT_NEAR(reaction.z(), -reaction_of(run.stepper.now(), run.model.bodies[2].rigid).z(), 1e-5);
  EXPECT_LT(run.stepper.take_convergence().size(), 60U);
}

TEST_P(DrivenBoneInTime, GoesOnFromARestartPointBitForBit) {
  Simulation whole(driven_pendulum(4e-3, GetParam()));
  whole.advance(0.24);
  const State at_restart = whole.state;
  whole.stepper.restart(whole.state);
  whole.advance(0.6);
  Simulation resumed(driven_pendulum(4e-3, GetParam()));
  resumed.state = at_restart;
  resumed.stepper.restart(resumed.state);
  resumed.advance(0.6);
  EXPECT_EQ(resumed.state.y, whole.state.y);
  EXPECT_EQ(resumed.state.energy.motion_work, whole.state.energy.motion_work);
}

const std::string kDriven = R"(
duration = "1 s"
[[body]]
name = "arm"
kind = "rigid"
geometry = { box = { size = "10 20 60 mm", cells = [1, 1, 1] } }
density = "1000 kg/m^3"
hold = { freedoms = ["translation.x", "translation.y", "translation.z", "rotation.y", "rotation.z"], at = "0 3 25 mm" }
[[body]]
name = "wall"
kind = "fixed"
[[ligament]]
name = "band"
path = [{ body = "wall", point = "0 30 -20 mm" }, { body = "arm", point = "0 10 -20 mm" }]
stiffness = "50 N/m"
reference_strain = 0.2
[[probe]]
name = "arm"
kind = "reaction"
body = "arm"
[[probe]]
name = "energy"
kind = "energy"
[integrator]
step = "10 ms"
[output]
interval = "0.1 s"
checkpoint_interval = "0.2 s"
)";

const std::string kTurn =
    "[[load]]\nkind = \"motion\"\nbody = \"arm\"\ntime = [\"0 s\", \"1 s\"]\n"
    "rotation = [\"0 0 0 deg\", \"0 0 40 deg\"]\n";

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

using DrivenBoneFile = ScenarioTest;

TEST_F(DrivenBoneFile, AnInterruptedRunGivesTheSameFilesBitForBit) {
  for (const char* analysis : {"dynamic", "static"}) {
    const Scenario s = read(kDriven + kTurn, {"analysis=" + std::string(analysis)});
    const Model model = build_model(s);
    const auto run_to = [&](double until, const std::string& name, bool resume) {
      RunOptions options;
      options.directory = folder_ / (name + analysis);
      options.resume = resume;
      options.after_step = [until](const State& state, double) { return state.t >= until; };
      run(s, model, options);
      return options.directory;
    };
    const auto whole = run_to(2, "whole", false);
    run_to(0.53, "parts", false);
    const auto parts = run_to(2, "parts", true);
    EXPECT_GT(content(whole / "history.csv").size(), 1000U);
    EXPECT_EQ(content(parts / "history.csv"), content(whole / "history.csv"));
    EXPECT_TRUE(content(parts / "checkpoint/state.bin") == content(whole / "checkpoint/state.bin"));
  }
}

TEST_F(DrivenBoneFile, AMotionIsAlongTheAxesOfTheHold) {
  std::string turned = kDriven + kTurn;
  turned.replace(turned.find(", at = "), 0, ", turned = \"90 0 0 deg\"");
  const Model model = build_model(read(turned));
  const Vec3 turn = model.rigid_bodies[0].motion->rotation[1];
  EXPECT_LT((turn - Vec3(0, -40 * std::numbers::pi / 180, 0)).norm(), 1e-12);
}

TEST_F(DrivenBoneFile, WhatCannotBeDrivenIsRefused) {
  const auto expect = [&](const std::string& load, const std::string& words) {
    const std::string message = refusal(kDriven + "[[load]]\nkind = \"motion\"\n" + load);
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_NE(message.find("jaw.toml:"), std::string::npos) << message;
  };
  const std::string arm = "body = \"arm\"\n", times = "time = [\"0 s\", \"1 s\"]\n";
  expect(arm + times + "rotation = [\"0 0 0 deg\", \"3 0 0 deg\"]",
         "drives `rotation.x`, which `hold` of body `arm` leaves free");
  expect(arm + "time = [\"0 s\", \"0 s\"]\nrotation = [\"0 0 0 deg\", \"0 0 3 deg\"]",
         "times must increase");
  expect(arm + times + "rotation = [\"0 0 0 mm\", \"0 0 3 mm\"]", "expected an angle");
  expect(arm + times + "translation = [\"1 0 0 mm\", \"0 0 3 mm\"]", "expected 0 at t = 0");
  expect(arm + times + "about = \"0 0 1 mm\"\nrotation = [\"0 0 0 deg\", \"0 0 3 deg\"]",
         "about the point `at`");
  expect(arm + times + "interpolation = \"linear\"\nrotation = [\"0 0 0 deg\", \"0 0 3 deg\"]",
         "whose velocity can't jump");
  expect(times + "body = \"none\"\nrotation = [\"0 0 0 deg\", \"0 0 3 deg\"]", "`none`");
  const std::string linear = kDriven + kTurn + "interpolation = \"linear\"\n";
  EXPECT_EQ(refusal(linear, {"analysis=static"}), "");
}

}  // namespace articular::sim::driven_rigid_body_test
