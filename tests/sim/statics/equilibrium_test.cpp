// Static analysis: closed forms, balance, what is not held, independence of units.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "fem/material/any_material.hpp"
#include "sim/base/error.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::equilibrium_test {

Scenario static_scene(double step) {
  Scenario s = scene(step);
  s.analysis = Scenario::Analysis::Static;
  return s;
}

/// A bar that hangs from a wall at z = L.
Scenario hanging_bar(double scale, const Vec3& origin, const TissueMaterial& material) {
  Scenario s = static_scene(1);
  const Vec3 size = scale * Vec3(0.02, 0.02, 0.08);
  s.bodies = {
      box_body("bar", Body::Kind::Tissue, size, origin + Vec3(0, 0, size.z() / 2), {2, 2, 8}),
      stand("wall")};
  s.bodies[0].material = material;
  const Vec3 wide = scale * Vec3(1, 1, 0);
  s.attachments = {attach("bar", "wall", origin - wide + Vec3(0, 0, 0.999 * size.z()),
                          origin + wide + Vec3(0, 0, 1.001 * size.z()))};
  s.loads = {gravity({0, 0, -9.81 / scale})};
  return s;
}

/// Displacement of the bar's free end per length: the mean over its face.
double end_displacement(const Simulation& run, double length) {
  const Tissue& tissue = run.model.tissues[0];
  const double limit = tissue.X.row(2).minCoeff() + 1e-6 * length;
  double sum = 0, area = 0;
  for (const auto& tet : tissue.elements.tets().colwise()) {
    std::vector<int> face;
    for (const int node : tet)
      if (tissue.X(2, node) < limit) face.push_back(node);
    if (face.size() != 3) continue;
    const Vec3 x0 = tissue.X.col(face[0]);
    const double a = (tissue.X.col(face[1]) - x0).cross(tissue.X.col(face[2]) - x0).norm();
    area += a;
    for (const int node : face)
      sum += a / 3 *
             (run.now().position(tissue.nodes[static_cast<std::size_t>(node)]).z() -
              tissue.X(2, node));
  }
  return sum / area / length;
}

// u(L)/L = ρ g L/(2E); with ν = 0 the mean over a section is exact on any mesh.
TEST(Equilibrium, ABarUnderItsOwnWeightGetsLongerByTheClosedForm) {
  Simulation run(hanging_bar(1, Vec3::Zero(), linear(15e3, 0)));
  run.advance(1);
  EXPECT_NEAR(end_displacement(run, 0.08), -1000 * 9.81 * 0.08 / (2 * 15e3), 1e-10);
  EXPECT_NEAR(run.force_on(0).z(), -1000 * 9.81 * 0.02 * 0.02 * 0.08, 1e-6 * 0.314);
  EXPECT_EQ(run.stepper.stored_energy().kinetic, 0);
}

// Energy stored and lost potential are the work of loads that rise in small steps; here gravity is
// there at once, so that the loss is the half that a sudden load wastes.
TEST(Equilibrium, WorkOfASlowlyDrivenWallIsStored) {
  const auto loss = [](double step) {
    Scenario s = hanging_bar(1, Vec3::Zero(), neo_hookean(15e3, 0.3));
    s.integrator.step = step;
    s.loads = {shift("wall", 1, {0.01, 0, 0.02})};
    s.bodies.push_back(stand("floor"));
    s.attachments.push_back(attach("bar", "floor", {-1, -1, -1e-6}, {1, 1, 1e-6}));
    Simulation run(s);
    run.advance(1);
    return std::abs(run.loss()) / run.stepper.stored_energy().elastic;
  };
  EXPECT_LT(loss(0.05), 2e-3);
  EXPECT_NEAR(std::log2(loss(0.1) / loss(0.05)), 2, 0.3);  // the ledger's trapezoidal rule
}

TEST(Equilibrium, NewtonsIterationConvergesQuadratically) {
  Simulation run(hanging_bar(1, Vec3::Zero(), neo_hookean(15e3, 0.3)));
  run.advance(1);
  const auto rows = run.stepper.take_convergence();
  ASSERT_GE(rows.size(), 3u);
  const double last = rows.back().newton.correction;
  const double before = rows[rows.size() - 2].newton.correction;
  const double first = rows[rows.size() - 3].newton.correction;
  EXPECT_GT(std::log(last / before) / std::log(before / first), 1.6);
}

// The same bar in m, mm and µm, and far from the origin: g grows as the length shrinks.
TEST(Equilibrium, TheAnswerDoesNotDependOnTheUnit) {
  const auto displacement = [](double scale, const Vec3& origin) {
    Simulation run(hanging_bar(scale, origin, neo_hookean(15e3, 0.45)));
    run.advance(1);
    return end_displacement(run, scale * 0.08);
  };
  const double expected = displacement(1, Vec3::Zero());
  EXPECT_LT(expected, -0.01);
  for (const double scale : {1e-3, 1e-4, 1e3})  // elements of 1e-18 m³ to 1000 m³
    EXPECT_NEAR(displacement(scale, Vec3::Zero()), expected, 1e-9) << scale;
  // 1000 m away coordinates have 13 digits, of a bar of 0.08 m 9.
  EXPECT_NEAR(displacement(1, {1000, -500, 800}), expected, 1e-7);
}

// A driven wall carries its tissue along: however far it turns in one step, nothing is strained.
TEST(Equilibrium, TissueOnATurningWallIsNotStrained) {
  Scenario s = hanging_bar(1, Vec3::Zero(), neo_hookean(15e3, 0.3));
  s.loads = {shift("wall", 1, {0.1, 0.2, -0.3})};
  std::get<MotionLoad>(s.loads[0]).motion.rotation = {Vec3::Zero(), Vec3(0.5, -1.5, 1)};
  Simulation run(s);
  run.advance(1);
  EXPECT_LT(run.stepper.stored_energy().elastic, 1e-16);  // of E V = 0.5 J: round-off
  EXPECT_LT(run.force_on(0).norm(), 1e-12);
}

// A mass on a ligament: the equilibrium is at weight/stiffness; gravity alone, sideways, must not
// matter. Rotations enter: the anchor is beside the centre, so that the body tilts.
TEST(Equilibrium, AHangingBodyTiltsUntilItsCentreIsBelowItsAnchor) {
  Scenario s = static_scene(1);
  s.bodies = {mass_body("mass", 2, {0.03, 0, 0}, {1e-3, 1e-3, 1e-3}), stand("wall")};
  Ligament ligament;
  ligament.name = "string";
  ligament.path = {anchor("wall", {0, 0, 0.1}), anchor("mass", Vec3::Zero())};
  ligament.law = Ligament::Law::Linear;
  ligament.stiffness = 1e4;
  s.ligaments = {ligament};
  s.loads = {gravity({0, 0, -9.81})};
  Simulation run(s);
  run.advance(1);
  const Pose& pose = run.now().poses[0];
  const double tension = 2 * 9.81;
  EXPECT_NEAR(pose.p.x(), 0, 1e-6);
  EXPECT_NEAR(pose.p.z(), 0.1 - (0.1 + tension / 1e4) - 0.03, 1e-6);
  ASSERT_EQ(run.stepper.indifferent().size(), 1u);  // it may turn about the string
}

Scenario falling_block() {
  Scenario s = static_scene(1);
  s.contact = true;
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.01, 0.01, 0.01}, {0, 0, 0.007}, {3, 3, 3}),
              box_body("floor", Body::Kind::Fixed, {0.04, 0.04, 0.004}, {0, 0, -0.002}, {3, 3, 1})};
  s.loads = {gravity({0, 0, -9.81})};
  return s;
}

constexpr double kArm = 0.1, kOut = 0.04, kTie = 0.1, kPull = 1e4;  // [m], [m], [m], [N/m]

/// An arm on a hinge along y, its centre kArm out along x. At kOut a tie of the length kTie and a
/// bit, straight above, which is slack.
Scenario arm_on_a_tie(double slack) {
  Scenario s = static_scene(1);
  s.bodies = {mass_body("arm", 1, {kArm, 0, 0}), stand("wall")};
  Hold& hinge = s.bodies[0].hold.emplace();
  hinge.held = {true, true, true, true, false, true};
  hinge.at = Vec3::Zero();
  Ligament tie;
  tie.name = "tie";
  tie.path = {anchor("wall", {kOut, 0, kTie}), anchor("arm", {kOut, 0, 0})};
  tie.stiffness = kPull;
  tie.slack_length = kTie + slack;
  s.ligaments = {tie};
  s.loads = {gravity({0, 0, -9.81})};
  return s;
}

/// The moment of the weight less that of the tie, where the arm has turned downwards [N m].
double moment_on_arm(double slack, double turn) {
  const double c = std::cos(turn), s = std::sin(turn);
  const Vec3 to_wall(kOut * (1 - c), 0, kTie + kOut * s);
  const double pull = std::max(0.0, kPull * (to_wall.norm() - kTie - slack)) / to_wall.norm();
  return 9.81 * kArm * c - pull * kOut * (c * to_wall.z() + s * to_wall.x());
}

// Until the tie is taut only the weight resists, and corrections are of many turns.
TEST(Equilibrium, AnArmSinksIntoItsSlackTie) {
  for (const double slack : {0.0, 0.2e-3, 0.5e-3, 1e-3, 2e-3, 3e-3, 4e-3}) {
    Simulation run(arm_on_a_tie(slack));
    run.advance(1);
    double low = 0, high = 0.5;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (moment_on_arm(slack, middle) > 0 ? low : high) = middle;
    }
    const Mat3& R = run.now().poses.front().R;
    EXPECT_NEAR(std::atan2(-R(2, 0), R(0, 0)), low, 1e-6) << slack;
  }
}

// Nothing holds the block until it lies on the floor: pseudo-time carries it there, and takes the
// energy of the fall.
TEST(Equilibrium, ABlockSettlesOnTheFloorAndItsWeightIsBalanced) {
  Simulation run(falling_block());
  run.advance(1);
  const double weight = 1000 * 1e-6 * 9.81;
  EXPECT_NEAR(run.stepper.dynamics().contact_summary(0).force.z(), weight, 1e-5 * weight);
  EXPECT_GT(run.state.counts.reported_pairs, 0);
  EXPECT_NEAR(run.state.energy.settling_loss, weight * 0.002, 0.02 * weight * 0.002);
  EXPECT_LT(std::abs(run.loss()), 0.02 * weight * 0.002);
  ASSERT_EQ(run.stepper.indifferent().size(), 1u);  // no friction: it may slide
  EXPECT_NE(run.stepper.indifferent()[0].words.find("`block`"), std::string::npos);
}

// A load that grows within the load step works by its mean, and pseudo-time takes no more than
// that.
TEST(Equilibrium, WhatGrowsAsItCarriesABlockToTheFloorWorksByItsMean) {
  Scenario s = falling_block();
  s.loads = {GravityLoad{{0, 0, -9.81}, {}, {{0, 1}, {0, 1}}}};
  Simulation run(s);
  run.advance(1);
  const double work = 0.5 * 1000 * 1e-6 * 9.81 * 0.002;
  EXPECT_NEAR(run.state.energy.load_work, work, 0.02 * work);
  // What pseudo-time takes of the last way, on which the block touches, is not counted: 4e-7 J.
  EXPECT_NEAR(run.state.energy.settling_loss, work, 0.05 * work);
  EXPECT_LT(std::abs(run.loss()), 0.05 * work);
}

TEST(Equilibrium, AMissingSupportIsNamed) {
  Scenario s = falling_block();
  s.bodies.pop_back();
  s.contact = false;
  Simulation run(s);
  try {
    run.advance(1);
    FAIL() << "a block fell for ever and was called at rest";
  } catch (const SimulationError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("body `block` can shift along (0.00 0.00 -1.00)"), std::string::npos)
        << what;
  }
}

// The same at rest, dynamic and static.
TEST(Equilibrium, IsWhereDynamicsComesToRest) {
  const auto tip = [](bool is_static) {
    Scenario s = hanging_bar(0.1, Vec3::Zero(), neo_hookean(15e3, 0.3));
    s.loads = {gravity({20, 0, 0})};
    s.analysis = is_static ? Scenario::Analysis::Static : Scenario::Analysis::Dynamic;
    s.integrator.step = is_static ? 1 : 0.02;  // so long that implicit Euler damps it within 1 s
    Simulation run(s);
    run.advance(1);
    double most = 0;
    for (const NodeRef& node : run.model.tissues[0].nodes)
      most = std::max(most, run.now().position(node).x());
    return most - 1e-3;
  };
  const double expected = tip(true);
  EXPECT_GT(expected, 1e-4);
  EXPECT_NEAR(tip(false), expected, 1e-4 * expected);
}

// What a tissue puts on each of its two bones: together its weight.
TEST(Equilibrium, AttachmentsShareTheWeight) {
  Scenario s = hanging_bar(1, Vec3::Zero(), neo_hookean(15e3, 0.3));
  s.bodies.push_back(stand("floor"));
  s.attachments.push_back(attach("bar", "floor", {-1, -1, -1e-6}, {1, 1, 1e-6}));
  Simulation run(s);
  run.advance(1);
  const auto [wall, wall_moment] = attachment_force(run.stepper.now(), 0, 0);
  const auto [floor, floor_moment] = attachment_force(run.stepper.now(), 0, 1);
  // The nodes that are tied hang on their bones by themselves: one of nine layers, two halves.
  const double weight = 1000 * 9.81 * 0.02 * 0.02 * 0.08;
  EXPECT_NEAR(wall.z() + floor.z(), -weight * 7 / 8, 0.02 * weight);
  EXPECT_LT(wall.z(), -0.3 * weight);
  EXPECT_LT(floor.z(), -0.3 * weight);
  EXPECT_LT(wall_moment.norm() + floor_moment.norm(), 0.01 * weight * 0.08);
  const double all = run.force_on(0).z() + run.force_on(1).z();
  EXPECT_NEAR(all, -weight, 1e-5 * weight);
}

/// A nearly incompressible smoothed block between a floor and a plate that presses it by 30 %.
Scenario pressed_block(double step) {
  Scenario s = static_scene(step);
  const double side = 0.02;
  s.bodies = {
      box_body("block", Body::Kind::Tissue, {side, side, side}, {0, 0, side / 2}, {2, 2, 4}),
      stand("floor"), stand("plate")};
  s.bodies[0].material = material_of(fem::MooneyRivlin<fem::LogVolumeChange>(1e3, 0, 500e3));
  s.bodies[0].material->element = TissueMaterial::Element::Smoothed;
  s.attachments = {attach("block", "floor", {-1, -1, -1e-6}, {1, 1, 1e-6}),
                   attach("block", "plate", {-1, -1, side - 1e-6}, {1, 1, side + 1e-6})};
  s.loads = {shift("plate", 1, {0, 0, -0.3 * side})};
  return s;
}

// What a single load step makes of it is inside out, where ln J is no number: the step is cut, and
// ends where twenty steps do.
TEST(Equilibrium, WhatIsNoNumberIsNoEquilibrium) {
  const auto force = [](double step) {
    Simulation run(pressed_block(step));
    run.advance(1);
    EXPECT_TRUE(run.state.y.allFinite());
    return run.force_on(1).z();
  };
  const double expected = force(0.05);
  EXPECT_GT(expected, 0);
  EXPECT_NEAR(force(1), expected, 1e-5 * expected);
}

/// Of a muscle's law with fibres along z, whose volumetric part is a logarithm too.
TissueMaterial muscle_material() {
  fem::BlemkerMuscle<fem::LogVolumeChange>::Constants ground;
  ground.c10 = 1e3;
  ground.kappa = 500e3;
  TissueMaterial material =
      material_of(fem::BlemkerMuscle<>(fem::MuscleFibre(fem::MuscleFibre::Constants{}), ground));
  material.element = TissueMaterial::Element::Smoothed;
  material.fibres = Fibres{Vec3::UnitZ()};
  return material;
}

/// The block's plate is turned by so much about the block's axis instead [rad].
Scenario twisted_block(double step, double angle) {
  Scenario s = pressed_block(step);
  MotionLoad turn = shift("plate", 1, Vec3::Zero());
  turn.motion.rotation = {Vec3::Zero(), Vec3(0, 0, angle)};
  s.loads = {turn};
  return s;
}

// One load step ends where ten do, or with an error: never as a result that is none.
TEST(Equilibrium, NoLawAndNoMotionOfALargeStepGivesWhatIsNoNumber) {
  const double half_turn = std::numbers::pi;
  for (const bool is_muscle : {false, true})
    for (const bool is_twist : {false, true}) {
      const auto end = [&](double step) {
        Scenario s = is_twist ? twisted_block(step, half_turn) : pressed_block(step);
        if (is_muscle) s.bodies[0].material = muscle_material();
        Simulation run(s);
        run.advance(1);
        EXPECT_TRUE(run.state.y.allFinite());
        return run.stepper.stored_energy().elastic;
      };
      const double expected = end(0.1);
      EXPECT_GT(expected, 0);
      EXPECT_NEAR(end(1), expected, 1e-3 * expected) << is_muscle << is_twist;
    }
}

TEST(Equilibrium, AForceBeyondNumbersIsNoEquilibrium) {
  Scenario s = hanging_bar(1, Vec3::Zero(), neo_hookean(15e3, 0.3));
  s.loads = {gravity({0, 0, -1e200})};  // its square is no number
  Simulation run(s);
  EXPECT_THROW(run.advance(1), SimulationError);
}

}  // namespace articular::sim::equilibrium_test
