// Time integration: closed forms, orders of convergence, conservation.
#include "sim/step/stepper.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::stepper_test {

using Scheme = Integrator::Scheme;

int order_of(Scheme scheme) {
  if (scheme == Scheme::Dirk3) return 3;
  return scheme == Scheme::TrBdf2 ? 2 : 1;
}

/// log2(error(h) / error(h/2)).
template <class Error>
double measured_order(const Error& error, double h) {
  return std::log2(error(h) / error(h / 2));
}

std::string name_of(const ::testing::TestParamInfo<Scheme>& info) {
  constexpr const char* kNames[] = {"ImplicitEuler", "TrBdf2", "Dirk3"};
  return kNames[static_cast<int>(info.param)];
}

class EachScheme : public ::testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Stepper, EachScheme,
                         ::testing::Values(Scheme::ImplicitEuler, Scheme::TrBdf2, Scheme::Dirk3),
                         name_of);

// z = −g t²/2. Implicit Euler adds −g h t/2; the second-order scheme is exact for a parabola.
TEST_P(EachScheme, RigidBodiesAndTissueFallFreely) {
  const double h = 1e-3, T = 0.1, g = 10;
  Scenario s = scene(h, GetParam());
  s.bodies = {mass_body("mass", 2),
              box_body("block", Body::Kind::Tissue, {0.02, 0.02, 0.02}, Vec3::Zero(), {2, 2, 2})};
  s.loads = {gravity({0, 0, -g})};
  Simulation run(s);
  run.advance(T);
  const double expected =
      -0.5 * g * T * T - (GetParam() == Scheme::ImplicitEuler ? 0.5 * g * h * T : 0);
  EXPECT_NEAR(run.now().poses[0].p.z(), expected, 1e-12);
  const Tissue& tissue = run.model.tissues[0];
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
    EXPECT_NEAR(run.now().position(tissue.nodes[i]).z() - tissue.X(2, static_cast<Eigen::Index>(i)),
                expected, 1e-10);
}

/// A symmetric top without torque: I 2, 2, 1, omega (1, 0, 10).
Scenario top(double h, Scheme scheme) {
  Scenario s = scene(h, scheme);
  s.bodies = {mass_body("top", 1, Vec3::Zero(), {2, 2, 1})};
  s.bodies[0].angular_velocity = {1, 0, 10};
  return s;
}

// Its axis turns about the angular momentum (2, 0, 10) at |H|/I1 = 5.09902 rad/s, positively.
double top_error(double h, Scheme scheme) {
  Simulation run(top(h, scheme));
  run.advance(0.5);
  const Vec3 H(2, 0, 10);
  const Vec3 axis = rotation_matrix(0.5 * H / 2) * Vec3::UnitZ();
  return (run.now().poses[0].R.col(2) - axis).norm();
}

TEST_P(EachScheme, ASymmetricTopPrecessesAtTheRateOfItsClosedForm) {
  const auto error = [](double h) { return top_error(h, GetParam()); };
  EXPECT_LT(error(1e-3), GetParam() == Scheme::TrBdf2 ? 1e-4 : 1e-2);  // of 1, after 2.55 rad
  EXPECT_NEAR(measured_order(error, 2e-3), order_of(GetParam()), 0.15);
}

// A mass on a spring swings beside a cube of tissue that falls: its residuals are many times those
// of the cube. z = −g h² n (n + 1)/2.
TEST(Stepper, TissueThatFallsDoesNotDriftWhileSomethingElseMoves) {
  constexpr double kStep = 1e-3;
  constexpr int kSteps = 500;
  Scenario s = scene(kStep);
  s.integrator.position_tolerance.reset();
  s.bodies = {box_body("cube", Body::Kind::Tissue, Vec3::Constant(0.01), {0.6, 0, 0}, {2, 2, 2}),
              mass_body("mass", 1, {0, 0.2, -0.1}), stand("wall")};
  s.bodies[0].material->element = TissueMaterial::Element::Smoothed;
  Ligament spring;
  spring.name = "spring";
  spring.path = {anchor("wall", {0, 0.2, 0}), anchor("mass", {0, 0.2, -0.1})};
  spring.stiffness = 1000;
  s.ligaments = {spring};
  s.loads = {gravity({0, 0, -9.81})};
  Simulation run(s);
  const Vec3 start = run.now().x.leftCols(run.model.layout.num_free_nodes).rowwise().mean();
  run.advance(kSteps * kStep);
  const Vec3 moved = run.now().x.leftCols(run.model.layout.num_free_nodes).rowwise().mean() - start;
  const double fall = 9.81 * kStep * kStep * kSteps * (kSteps + 1) / 2;
  EXPECT_LT((moved - Vec3(0, 0, -fall)).norm(), 1e-6 * fall);
}

// Seen from the top its angular velocity turns at (I3 − I1)/I1 omega_3 = −5 rad/s.
TEST(Stepper, ASymmetricTopsAngularVelocityPrecessesBackwardsInItsOwnFrame) {
  Simulation run(top(1e-3, Scheme::TrBdf2));
  run.advance(0.3);
  const Vec3 omega = run.now().poses[0].R.transpose() * run.now().velocities[0].angular;
  EXPECT_NEAR(std::atan2(omega.y(), omega.x()), -1.5, 1e-3);
  EXPECT_NEAR(omega.z(), 10, 1e-3);
}

TEST_P(EachScheme, AngularMomentumDriftsAtTheSchemesOrder) {
  const auto drift = [](double h) {
    Scenario s = scene(h, GetParam());
    s.bodies = {mass_body("body", 1, Vec3::Zero(), {1, 2, 3})};
    s.bodies[0].angular_velocity = {3, 4, 5};
    Simulation run(s);
    run.advance(0.4);
    const Mat3& R = run.now().poses[0].R;
    const Vec3 H = R * Vec3(1, 2, 3).asDiagonal() * R.transpose() * run.now().velocities[0].angular;
    return (H - Vec3(3, 8, 15)).norm();
  };
  // Of implicit Euler by what Newton's iteration leaves alone, see keep_angular_momentum().
  if (GetParam() == Scheme::ImplicitEuler)
    EXPECT_LT(drift(0.02), 1e-8 * 17);
  else
    EXPECT_NEAR(measured_order(drift, 1e-3), order_of(GetParam()), 0.2);
}

// 0.1 rad a step about an axis between those of its inertia. It ends spinning about the axis of the
// largest moment, with the least energy that its angular momentum can have, |H|²/2I₃.
TEST(Stepper, ImplicitEulerTakesEnergyFromATumblingBodyAndNeverGivesIt) {
  Scenario s = scene(1e-3);
  s.bodies = {mass_body("body", 1, Vec3::Zero(), {1, 2, 2.5})};
  s.bodies[0].angular_velocity = {60, 50, 60};
  Simulation run(s);
  const double least = Vec3(60, 100, 150).squaredNorm() / 5;
  double energy = run.stepper.stored_energy().kinetic;
  run.advance(3, [&] {
    const double now = run.stepper.stored_energy().kinetic;
    EXPECT_LE(now, energy * (1 + 1e-12));
    energy = now;
  });
  EXPECT_GE(energy, least * (1 - 1e-6));  // Newton's iteration ends at 1e-9 m
  EXPECT_LT(energy, 1.01 * least);
}

TEST(Stepper, ABodyThatSpinsAboutItsMiddleAxisTurnsOver) {
  Scenario s = scene(2e-3, Scheme::TrBdf2);
  s.bodies = {mass_body("body", 1, Vec3::Zero(), {1, 2, 3})};
  s.bodies[0].angular_velocity = {0.01, 5, 0};
  Simulation run(s);
  double least = 5, most_after = -5;
  run.advance(9, [&] {
    const Vec3 omega = run.now().poses[0].R.transpose() * run.now().velocities[0].angular;
    if (omega.y() < least) most_after = omega.y();
    least = std::min(least, omega.y());
    most_after = std::max(most_after, omega.y());
  });
  EXPECT_LT(least, -4.9);
  EXPECT_GT(most_after, 4.9);  // and back
}

/// A mass on a muscle 100 m long: its length does not change noticeably.
Scenario mass_on_muscle(double step, Scheme scheme) {
  Scenario s = scene(step, scheme);
  s.bodies = {mass_body("mass", 2), stand("wall")};
  Muscle muscle;
  muscle.name = "muscle";
  muscle.path = {anchor("wall", {0, 0, 100}), anchor("mass", Vec3::Zero())};
  muscle.max_force = 3;
  muscle.max_velocity = 1e9;
  muscle.excitation = {{0}, {1}};
  s.muscles = {muscle};
  return s;
}

TEST_P(EachScheme, AConstantMuscleForceMovesAMassByHalfTheAccelerationTimesTheTimeSquared) {
  const double h = 1e-3, T = 0.1;
  Simulation run(mass_on_muscle(h, GetParam()));
  run.advance(T);
  const double expected = 3.0 / (2 * 2) * T * (T + (GetParam() == Scheme::ImplicitEuler ? h : 0));
  // The force-length factor falls by (π dz/l)² = 5e-8.
  EXPECT_NEAR(run.now().poses[0].p.z(), expected, 1e-6 * expected);
  EXPECT_NEAR(run.state.energy.muscle_work, 3 * expected, 1e-6 * 3 * expected);
}

// Hill, a/P0 = 1/4: a light mass under half the muscle's force is pulled at vmax/6.
TEST(Stepper, AMuscleUnderHalfItsForceShortensAtASixthOfItsGreatestSpeed) {
  Scenario s = mass_on_muscle(1e-3, Scheme::ImplicitEuler);
  s.bodies[0].mass = 1e-4;
  s.muscles[0].max_velocity = 0.01;  // 1 m/s
  ForceLoad load;
  load.at = anchor("mass", Vec3::Zero());
  load.force = {0, 0, -1.5};
  s.loads = {load};
  Simulation run(s);
  run.advance(0.05);
  EXPECT_NEAR(run.now().velocities[0].linear.z(), 1.0 / 6, 1e-6);
}

TEST_P(EachScheme, ActivationRisesAsOneMinusTheExponential) {
  const double tau = 0.015, T = 0.02;
  const auto error = [&](double h) {
    Scenario s = mass_on_muscle(h, GetParam());
    s.muscles[0].activation_time = tau;
    s.muscles[0].excitation = {{0, 1e-9}, {0, 1}};
    Simulation run(s);
    run.advance(1e-9);
    run.advance(T);
    const double risen = T - 0.5e-9;  // the excitation's ramp counts half
    return std::abs(run.now().activation[0] - (1 - std::exp(-risen / tau)));
  };
  EXPECT_LT(error(1e-3), GetParam() == Scheme::TrBdf2 ? 1e-3 : 0.03);
  EXPECT_NEAR(measured_order(error, 5e-4), order_of(GetParam()), 0.1);
}

/// 1 kg on a ligament of 400 N/m, let go where it carries half the weight: it stays taut.
/// omega = 20 rad/s about the length at rest.
Scenario oscillator(double h, Scheme scheme) {
  Scenario s = scene(h, scheme);
  s.bodies = {mass_body("mass", 1), stand("wall")};
  Ligament ligament;
  ligament.name = "spring";
  ligament.path = {anchor("wall", {0, 0, 1}), anchor("mass", Vec3::Zero())};
  ligament.stiffness = 400;
  ligament.slack_extension = -5.0 / 400;
  s.ligaments = {ligament};
  s.loads = {gravity({0, 0, -10})};
  return s;
}

TEST_P(EachScheme, AMassOnALinearLigamentSwingsWithItsPeriodAtTheSchemesOrder) {
  const auto error = [](double h) {
    Simulation run(oscillator(h, GetParam()));
    const double T = 0.4;
    run.advance(T);
    const double expected = -5.0 / 400 * (1 - std::cos(20 * T));
    return std::abs(run.now().poses[0].p.z() - expected);
  };
  EXPECT_NEAR(measured_order(error, 1e-3), order_of(GetParam()), 0.15);
}

TEST_P(EachScheme, NumericalLossGoesToZeroWithTheStep) {
  const auto loss = [](double h) {
    Simulation run(oscillator(h, GetParam()));
    double least = 0;
    run.advance(0.4, [&] {
      least = std::min(least, run.loss());
      EXPECT_NEAR(run.loss() + run.stepper.stored_energy().total(), run.state.energy.start, 1e-12);
    });
    if (GetParam() == Scheme::ImplicitEuler) {
      EXPECT_GE(least, -1e-12);
    }
    EXPECT_GT(run.loss(), 0);
    return run.loss();
  };
  // Implicit Euler loses with h, TR-BDF2's amplitude with h³.
  EXPECT_NEAR(measured_order(loss, 1e-3), GetParam() == Scheme::ImplicitEuler ? 1 : 3, 0.2);
}

// A slender bar stretched and let go. Second order needs the stiff modes resolved: small steps.
TEST_P(EachScheme, ATissueBarVibratesAtTheSchemesOrder) {
  const auto end = [](double h) {
    Scenario s = scene(h, GetParam());
    s.bodies = {box_body("bar", Body::Kind::Tissue, {0.06, 0.02, 0.02}, Vec3::Zero(), {3, 1, 1}),
                stand("wall")};
    s.attachments = {attach("bar", "wall", {-1, -1, -1}, {-0.0299, 1, 1})};
    s.loads = {gravity({2, 0, -1})};
    Simulation run(s);
    run.advance(0.02);
    return Eigen::VectorXd(run.state.y.head(3 * run.model.layout.num_free_nodes));
  };
  const Eigen::VectorXd exact = [&] {
    Eigen::VectorXd a = end(6.25e-5);
    const Eigen::VectorXd b = end(3.125e-5);
    const double gain = std::pow(2, order_of(GetParam())) - 1;
    return Eigen::VectorXd(b + (b - a) / gain);
  }();
  const auto error = [&](double h) { return (end(h) - exact).norm(); };
  EXPECT_NEAR(measured_order(error, 5e-4), order_of(GetParam()), 0.25);
}

TEST(Stepper, AttachedTissueFollowsItsDrivenBoneExactly) {
  Scenario s = scene(5e-3);
  const Vec3 size(0.02, 0.02, 0.02);
  s.bodies = {box_body("block", Body::Kind::Tissue, size, Vec3::Zero(), {2, 2, 2}), stand("hand")};
  s.attachments = {attach("block", "hand", {-1, -1, 0.0099}, {1, 1, 1})};
  MotionLoad load;
  load.body = "hand";
  load.motion.time = {0, 0.1};
  load.motion.translation = {Vec3::Zero(), {0.01, 0, 0.02}};
  load.motion.rotation = {Vec3::Zero(), {1.0, 0.5, -0.7}};
  load.motion.about = {0.1, 0, 0};
  s.loads = {load};
  Simulation run(s);
  const Tissue& tissue = run.model.tissues[0];
  int attached = 0;
  run.advance(0.1, [&] {
    const double at = run.state.t / 0.1, blend = at * at * (3 - 2 * at);
    const Mat3 R = rotation_matrix(blend * load.motion.rotation[1]);
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      if (tissue.nodes[i].rigid < 0) continue;
      ++attached;
      const Vec3 X = tissue.X.col(static_cast<Eigen::Index>(i));
      const Vec3 x =
          load.motion.about + R * (X - load.motion.about) + blend * load.motion.translation[1];
      EXPECT_NEAR((run.now().position(tissue.nodes[i]) - x).norm(), 0, 1e-14);
    }
  });
  EXPECT_EQ(attached, 9 * 20);
}

// A bar without lateral contraction, stretched by a driven end: E A ε at either end. The work of
// the drive is what the bar stores, and the trapezoidal rule is exact for a force linear in the
// path.
TEST(Stepper, AStretchedBarPullsItsDrivenAndItsFixedEndAlikeAndStoresTheWork) {
  Scenario s = scene(0.02);
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.01, 0.01, 0.03}, Vec3::Zero(), {1, 1, 3}),
              stand("wall"), stand("hand")};
  s.bodies[0].material = linear(20e3, 0);
  s.attachments = {attach("bar", "wall", {-1, -1, -1}, {1, 1, -0.0149}),
                   attach("bar", "hand", {-1, -1, 0.0149}, {1, 1, 1})};
  s.loads = {shift("hand", 2, {0, 0, 0.003})};
  Simulation run(s);
  run.advance(2);
  run.advance(4);
  const double expected = 20e3 * 1e-4 * 0.1;
  EXPECT_NEAR(run.force_on(0).z(), expected, 1e-6 * expected);
  EXPECT_NEAR(run.force_on(1).z(), -expected, 1e-6 * expected);
  const double stored = 0.5 * expected * 0.003;
  EXPECT_NEAR(run.stepper.stored_energy().elastic, stored, 1e-6 * stored);
  EXPECT_NEAR(run.state.energy.motion_work, stored, 1e-3 * stored);
}

/// A rigid box at rest is pulled down by this part of the margin in a step [m]; below it, a floor.
struct PulledBox {
  static constexpr double kStep = 1e-3, kMargin = 1e-3, kSize = 0.02;

  PulledBox(double part_of_margin, double gap)
      : run(scene_of(part_of_margin, gap), detection_margin_of(kMargin)) {
    run.advance(kStep);
  }
  static Scenario scene_of(double part_of_margin, double gap) {
    Scenario s = contact_scene(kStep);
    s.bodies = {box_body("box", Body::Kind::Rigid, Vec3::Constant(kSize)),
                box_body("floor", Body::Kind::Fixed, Vec3::Constant(kSize), {0, 0, -kSize - gap})};
    s.loads = {gravity({0, 0, -part_of_margin * kMargin / (kStep * kStep)})};
    return s;
  }

  Simulation run;
};

// Pairs are known up to the margin, of which each of two bodies may use half.
TEST(Stepper, ContactsAreLookedForAgainWhereABodyStraysByMoreThanHalfTheMargin) {
  const double far = 1;
  const PulledBox slow(0.45, far), fast(0.55, far), faster(0.95, far);
  EXPECT_GT(fast.run.state.counts.tree_updates, slow.run.state.counts.tree_updates);
  EXPECT_EQ(faster.run.state.counts.tree_updates, fast.run.state.counts.tree_updates);
}

// What was not looked for and does not touch where the step ends does not cost the step.
TEST(Stepper, AStepIsRepeatedWhereContactsThatWereNotLookedForTouch) {
  const PulledBox free(1.5, 1), stopped(1.5, 1.1 * PulledBox::kMargin);
  EXPECT_EQ(free.run.state.counts.rejected_motion, 0);
  EXPECT_EQ(free.run.force_on(1).norm(), 0);
  EXPECT_EQ(stopped.run.state.counts.rejected_motion, 1);
  EXPECT_LT(stopped.run.force_on(1).z(), 0);
}

// v = v0 exp(−α t) of a block that mass damping alone slows down: it loses
// ½ m v0² (1 − exp(−2 α t)), which the ledger adds up with an error of second order.
TEST(Stepper, WhatDampingTakesFromATissueIsTheIntegralOfItsPower) {
  const double alpha = 20, T = 0.1, v0 = 0.3, size = 0.02;
  const double loss = 0.5 * 1000 * std::pow(size, 3) * v0 * v0 * (1 - std::exp(-2 * alpha * T));
  const auto error = [&](double h) {
    Scenario s = scene(h, Scheme::TrBdf2);
    s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(size))};
    s.bodies[0].velocity = {v0, 0, 0};
    s.bodies[0].material->mass_damping = alpha;
    Simulation run(s);
    run.advance(T);
    return std::abs(run.state.energy.tissue_loss - loss);
  };
  EXPECT_LT(error(1e-3), 1e-3 * loss);
  EXPECT_NEAR(measured_order(error, 4e-3), 2, 0.1);
}

TEST(Stepper, AStepEndsWhereItIsAskedTo) {
  Simulation run(oscillator(1e-3, Scheme::ImplicitEuler));
  for (const double target : {0.0101, 0.0101 + 2e-9, 1.0 / 3}) {
    run.advance(target);
    EXPECT_EQ(run.state.t, target);
  }
}

// Round-off between two times that were meant to be one must not stop a run.
TEST(Stepper, ATargetThatIsNextToTheTimeIsReachedToo) {
  Simulation run(oscillator(1e-3, Scheme::ImplicitEuler));
  run.advance(0.01);
  run.advance(0.01 + 5e-13);
  EXPECT_EQ(run.state.t, 0.01 + 5e-13);
}

TEST(Stepper, ASceneWithoutUnknownsJustGoesOn) {
  Scenario s = scene(0.01);
  s.bodies = {box_body("tool", Body::Kind::Fixed, Vec3::Ones())};
  s.loads = {shift("tool", 0.1, {1, 0, 0})};
  Simulation run(s);
  run.advance(0.1);
  EXPECT_NEAR(run.now().poses[0].p.x(), 1, 1e-12);
}

// Element loops, multigrid and the search for contacts share their work among threads in pieces
// that do not depend on the number of threads.
TEST(Threads, ChangeNoBitOfAResult) {
  const auto state_of = [](int threads, TissueMaterial::Element element) {
    Scenario s = scene(2e-3);
    s.threads = threads;
    s.integrator.solver = Integrator::Solver::Multigrid;
    s.integrator.position_tolerance = 1e-7;
    s.contact = true;
    s.bodies = {
        box_body("floor", Body::Kind::Fixed, {0.2, 0.2, 0.02}, {0, 0, -0.01}),
        box_body("block", Body::Kind::Tissue, {0.1, 0.1, 0.1}, {0, 0, 0.0501}, {12, 12, 12})};
    s.bodies[1].material->element = element;
    s.bodies[1].velocity = {0.1, 0, -0.3};
    s.loads = {gravity({0, 0, -9.81})};
    Simulation run(s);
    run.advance(6e-3);
    EXPECT_GT(run.state.counts.reported_pairs, 0);
    return run.state.y;
  };
  for (const auto element : {TissueMaterial::Element::Plain, TissueMaterial::Element::Smoothed}) {
    const Eigen::VectorXd one = state_of(1, element);
    EXPECT_EQ(one, state_of(2, element));
    EXPECT_EQ(one, state_of(3, element));
  }
}

TEST(Stepper, NothingThatIsNoNumberPassesAStep) {
  for (const auto analysis : {Scenario::Analysis::Dynamic, Scenario::Analysis::Static}) {
    Scenario s = scene(1e-3);
    s.analysis = analysis;
    s.bodies = {box_body("block", Body::Kind::Tissue, {0.02, 0.02, 0.02}), stand("floor")};
    s.attachments = {attach("block", "floor", {-1, -1, -1}, {1, 1, -0.009})};
    Simulation run(s);
    run.state.y[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(run.stepper.step(run.state, 1e-3), SimulationError);
  }
}

}  // namespace articular::sim::stepper_test
