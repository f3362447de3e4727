// What a run says of itself: energy that was lost or made, elements inside out, deep contact.
#include "sim/output/run_warnings.hpp"
#include "sim/build/build_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "fem/material/any_material.hpp"
#include "sim/base/error.hpp"
#include "sim/run/run.hpp"
#include "sim/step/run_extrema.hpp"
#include "tests/sim/support/scene.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::run_warnings_test {

std::string all_warnings(const Simulation& run) {
  std::string all;
  for (const std::string& warning : run_warnings(run.model, run.state, run.stepper))
    all += warning + "\n";
  return all;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A column that gravity begins to pull; it swings with a period of 10 ms.
Scenario column(double step, Integrator::Scheme scheme) {
  Scenario s = scene(step, scheme);
  s.bodies = {box_body("column", Body::Kind::Tissue, {0.002, 0.002, 0.01}, Vec3::Zero(), {1, 1, 5}),
              stand("wall")};
  s.attachments = {attach("column", "wall", {-1, -1, 0.00499}, {1, 1, 1})};
  s.loads = {gravity({0, 0, -10})};
  return s;
}

TEST(RunWarnings, ASwingThatItsStepsDampIsTold) {
  Simulation run(column(5e-3, Integrator::Scheme::ImplicitEuler));
  run.advance(0.01);
  EXPECT_TRUE(has(all_warnings(run), "the time integration took")) << all_warnings(run);
}

std::string all_notes(const Simulation& run) {
  std::string all;
  for (const std::string& note : run_notes(run.model, run.state, run.stepper)) all += note + "\n";
  return all;
}

// What hangs at rest at last hangs where it should, whatever the steps took on the way.
TEST(RunWarnings, OneThatCameToRestIsANoteThatSaysWhatIsNotTouched) {
  Simulation run(column(5e-3, Integrator::Scheme::ImplicitEuler));
  run.advance(0.01);
  EXPECT_TRUE(has(all_warnings(run), "the time integration took"));
  EXPECT_EQ(all_notes(run), "");
  run.advance(0.4);
  EXPECT_EQ(all_warnings(run), "");
  EXPECT_TRUE(has(all_notes(run), "What rests from t = 0.01 s on")) << all_notes(run);
}

// At the ends of a swing there is no speed for a moment.
TEST(RunWarnings, APendulumThatTurnsDoesNotRest) {
  Simulation run(column(1e-3, Integrator::Scheme::TrBdf2));
  run.advance(0.005);
  bool rested = false;
  double least = 1;  // kinetic energy by that turned over
  for (int ms = 5; ms < 60; ++ms) {
    const double t = 1e-3 * ms;
    run.advance(t);
    least = std::min(least, run.stepper.stored_energy().kinetic / turned_over(run.state));
    rested = rested || is_at_rest(run.state);
  }
  EXPECT_FALSE(rested);
  EXPECT_LT(least, 0.05);
}

TEST(RunWarnings, WhereThereIsFrictionTheWayToRestMayDecideWhereItIs) {
  for (const double friction : {0.0, 0.5}) {
    Scenario s = column(5e-3, Integrator::Scheme::ImplicitEuler);
    s.contact = true;
    s.bodies.push_back(box_body("floor", Body::Kind::Fixed, {0.1, 0.1, 0.01}, {0, 0, -0.05}));
    ContactPair pair;
    pair.a = "column";
    pair.b = "floor";
    pair.friction = friction;
    s.contacts = {pair};
    Simulation run(s);
    run.advance(0.44);
    EXPECT_EQ(has(all_warnings(run), "the time integration took"), friction > 0);
    EXPECT_EQ(all_notes(run).empty(), friction > 0);
  }
}

TEST(RunWarnings, OneThatIsFollowedGivesNone) {
  Simulation run(column(1e-4, Integrator::Scheme::Dirk3));
  run.advance(0.02);
  EXPECT_EQ(all_warnings(run), "");
}

// All of a block lies mirrored at the start: every element is inside out, and comes back.
TEST(RunWarnings, ElementsInsideOutAreNamed) {
  Scenario s = scene(2e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.01, 0.01, 0.01}, Vec3::Zero(), {2, 2, 2})};
  Simulation run(s);
  run.state.y.head(3 * run.model.layout.num_free_nodes) *= -1;
  run.stepper.restart(run.state);
  run.state.energy.start = run.stepper.stored_energy().total();
  run.advance(2e-3);
  EXPECT_LT(run.state.extrema.least.ratio, 0);
  EXPECT_TRUE(has(all_warnings(run), "of tissue `block` was inside out")) << all_warnings(run);
}

/// Of a block whose nodes lie `size` times as far from its middle at the start.
std::string warnings_of_scaled_block(double size) {
  Scenario s = scene(1e-5);
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.01, 0.01, 0.01}, Vec3::Zero(), {2, 2, 2})};
  Simulation run(s);
  run.state.y.head(3 * run.model.layout.num_free_nodes) *= size;
  run.stepper.restart(run.state);
  run.state.energy.start = run.stepper.stored_energy().total();
  run.advance(1e-5);
  return all_warnings(run);
}

TEST(RunWarnings, ElementsThatAreCrushedAreNamed) {
  for (const double size : {0.2, 0.9})
    EXPECT_EQ(has(warnings_of_scaled_block(size), "of tissue `block` was crushed to 0.00"),
              size == 0.2);
}

TEST(RunWarnings, ElementsThatGrowFarAreNamed) {
  for (const double size : {1.1, 1.6})
    EXPECT_EQ(has(warnings_of_scaled_block(size), "of tissue `block` grew to 4.1 times its volume"),
              size == 1.6);
}

/// Soft tissue between two plates, pressed to a part of its height, and let go again.
Scenario press(double stretch, bool lifted) {
  constexpr double kSide = 0.01;
  Scenario s = scene(0.01);
  s.contact = true;
  s.integrator.position_tolerance.reset();
  const Vec3 plate(0.06, 0.06, 0.01);
  s.bodies = {
      box_body("floor", Body::Kind::Fixed, plate, {0, 0, -0.01}),
      box_body("press", Body::Kind::Fixed, plate, {0, 0, 0.01}),
      box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), Vec3::Zero(), {2, 2, 2})};
  s.bodies[2].material = neo_hookean(1e4, 0.49);
  s.bodies[2].material->mass_damping = 20;
  const Vec3 way(0, 0, -(1 - stretch) * kSide);
  s.loads = {shift("press", 0.5, way)};
  if (lifted) {
    Motion& motion = std::get<MotionLoad>(s.loads[0]).motion;
    motion.time.push_back(1);
    motion.translation.emplace_back(Vec3::Zero());
  }
  return s;
}

// Contact is the first to be asked where energy came from nothing.
TEST(RunWarnings, EnergyThatWasMadeIsToldWithTheDeepestContact) {
  Simulation run(press(0.05, false));
  run.advance(0.5);
  EXPECT_FALSE(has(all_warnings(run), "were made out of nothing")) << all_warnings(run);
  note_balance(-0.02 * turned_over(run.state), run.state);
  const std::string told = all_warnings(run);
  EXPECT_TRUE(has(told, "were made out of nothing")) << told;
  EXPECT_TRUE(has(told, "contact of `")) << told;
  EXPECT_TRUE(has(told, "where deep contact did")) << told;
}

TEST(RunWarnings, EnergyThatWasMadeInBetweenIsTold) {
  Simulation run(column(1e-4, Integrator::Scheme::Dirk3));
  run.advance(0.02);
  note_balance(-0.02 * turned_over(run.state), run.state);
  EXPECT_TRUE(has(all_warnings(run), "made out of nothing, 2 % of")) << all_warnings(run);
}

TEST(RunWarnings, MoreEnergyMadeThanGivenEndsTheRun) {
  Simulation run(column(1e-4, Integrator::Scheme::Dirk3));
  run.advance(0.01);
  note_balance(-1e3 * turned_over(run.state), run.state);
  EXPECT_THROW(run.advance(0.02), SimulationError);
}

// A tumbling body gains energy from this scheme.
TEST(RunWarnings, EnergyMadeBetweenFramesIsNoted) {
  const TemporaryFolder folder;
  Scenario s = scene(0.02, Integrator::Scheme::TrBdf2);
  s.bodies = {box_body("body", Body::Kind::Rigid, {0.01, 0.02, 0.03}, Vec3::Zero(), {1, 1, 1})};
  s.bodies[0].angular_velocity = {3, 4, 5};
  s.duration = 0.5;
  s.output.interval = 1;  // the next frame is that of the end
  double noted = 0;       // [J]
  RunOptions options;
  options.directory = folder.path();
  options.after_step = [&](const State& state, double duration) {
    if (state.t < duration) noted = state.extrema.made;
    return false;
  };
  run(s, build_model(s), options);
  EXPECT_GT(noted, 0);
}

// When it is let go again a press has done no work on the whole: what it had done in between is
// what a loss is much or little of.
TEST(RunWarnings, APressThatIsLiftedAgainGivesNone) {
  Simulation run(press(0.8, true));
  double most = 0;
  run.advance(1, [&] { most = std::max(most, run.stepper.stored_energy().elastic); });
  EXPECT_LT(std::abs(run.state.energy.motion_work), 0.1 * most);
  EXPECT_GT(turned_over(run.state), 0.99 * most);
  EXPECT_EQ(all_warnings(run), "");
}

/// Cubes that are held with one corner in a floor: it is all that is in it, and no node carries a
/// force.
Scenario cubes_on_corners(int count, const Eigen::Vector3i& floor_cells = {30, 3, 1}) {
  Scenario s = scene(1e-3);
  s.contact = true;
  s.bodies = {
      box_body("floor", Body::Kind::Fixed, {0.3, 0.03, 0.01}, {0.1, 0, -0.005}, floor_cells),
      stand("stand")};
  for (int i = 0; i < count; ++i) {
    const std::string name = "cube " + std::to_string(i);
    Body cube = box_body(name, Body::Kind::Tissue, Vec3::Constant(0.01), Vec3::Zero());
    cube.material = neo_hookean(1e5, 0.3);
    // The space diagonal stands upright.
    const double angle = std::acos(1 / std::sqrt(3.0));
    cube.placement.rotation = angle * Vec3::Ones().cross(Vec3::UnitZ()).normalized();
    cube.placement.translation = {0.03 * i, 0, 0.005 * std::sqrt(3.0) - 4e-4};
    s.bodies.push_back(cube);
    s.contacts.push_back({"floor", name, {}});
    s.attachments.push_back(attach(name, "stand", {-1, -1, 5e-3}, {1, 1, 1}));
  }
  return s;
}

// What more than a few contacts have in common is counted: other warnings have to be seen.
TEST(RunWarnings, OfManyUnresolvedContactsSomeAreNamedAndTheRestCounted) {
  for (const int count : {4, 7}) {
    Simulation run(cubes_on_corners(count));
    run.advance(1e-3);
    const std::string told = all_warnings(run);
    EXPECT_TRUE(has(told, "`floor` and `cube 3` is not resolved at the end: ")) << told;
    EXPECT_FALSE(has(told, "`cube 4`")) << told;
    EXPECT_EQ(has(told, "\n3 more contacts are not resolved"), count == 7) << told;
  }
}

// How large the floor's elements are says nothing about what a cube bears.
TEST(RunWarnings, ACubeInAFloorOfLargeElementsIsNotMissed) {
  Simulation run(cubes_on_corners(1, {1, 1, 1}));
  run.advance(1e-3);
  EXPECT_TRUE(has(all_warnings(run), "`floor` and `cube 0` is not resolved at the end: "))
      << all_warnings(run);
}

// A run is stopped once most of its energy has come from nowhere, with the fastest body by name.
TEST(RunWarnings, EnergyMadeOfNothingEndsARun) {
  Scenario s = scene(1e-3);
  s.bodies = {mass_body("mass", 1)};
  s.bodies[0].velocity = {0, 0, 3};
  Simulation run(s);
  run.advance(2e-3);
  run.state.energy.start -= 4;  // of 4.5 J: as if it had begun slower
  try {
    run.advance(3e-3);
    FAIL() << "it went on";
  } catch (const SimulationError& error) {
    EXPECT_TRUE(has(error.what(), "made out of nothing")) << error.what();
    EXPECT_TRUE(has(error.what(), "body `mass` (3 m/s)")) << error.what();
  }
}

/// A driven block goes down into a fixed one that it stands on [m].
Scenario driven_block(double down, std::optional<Layer> layer) {
  Scenario s = scene(1);
  s.contact = true;
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("base", Body::Kind::Fixed, {0.02, 0.02, 0.004}, {0, 0, -0.002}, {1, 1, 1}),
              box_body("top", Body::Kind::Rigid, {0.01, 0.01, 0.004}, {0, 0, 0.002}, {1, 1, 1})};
  s.bodies[1].hold.emplace().held.fill(true);
  s.bodies[0].layer = layer;
  s.loads = {shift("top", 1, {0, 0, -down})};
  return s;
}

// The force of such a contact is that of its stiffness, which is a means and no property.
TEST(RunWarnings, RigidBodiesDrivenIntoEachOtherHaveNoForceThatMeansAnything) {
  for (const double down : {0.0, 1e-4}) {
    Simulation run(driven_block(down, {}));
    run.advance(1);
    EXPECT_EQ(has(all_warnings(run),
                  "`base` and `top` are both where the scenario puts them, and "
                  "lay in each other by 0.1 mm"),
              down > 0)
        << all_warnings(run);
  }
}

TEST(RunWarnings, ALayerThatIsPressedByMoreThanItHasIsTold) {
  for (const double down : {4e-4, 6e-4}) {
    Simulation run(driven_block(down, Layer{5e-4, 1e6, 0.3}));
    run.advance(1);
    const std::string told = all_warnings(run);
    EXPECT_EQ(has(told,
                  "`base` and `top` were pressed into the layer between them at t = 1 s, by "
                  "1.2 times its thickness"),
              down > 5e-4)
        << told;
    EXPECT_FALSE(has(told, "are both where")) << told;
  }
}

// Two kilonewtons on a layer that follows a body for a quarter of that: no support is missing.
TEST(RunWarnings, ALoadThatPressesALayerThroughNamesTheLayer) {
  Scenario s = driven_block(0, Layer{5e-4, 1e6, 0.3});
  s.bodies[1].hold->held[2] = false;
  s.loads = {ForceLoad{anchor("top", {0, 0, 2e-3}), {0, 0, -2000}, {}, {}}};
  Simulation run(s);
  try {
    run.advance(1);
    FAIL() << "it went on";
  } catch (const SimulationError& error) {
    EXPECT_TRUE(has(error.what(), "or the layer of `base`, 0.5 mm thick, is pressed through"))
        << error.what();
  }
}

/// Of a ligament of 8 mm that is drawn out, and slack again at the end.
std::string told_of_ligament(double stretch, Ligament::Law law) {
  Scenario s = driven_block(0, {});
  s.contact = false;
  s.loads = {shift("top", 0.5, {0, 0, stretch})};
  Motion& motion = std::get<MotionLoad>(s.loads[0]).motion;
  motion.time.push_back(1);
  motion.translation.emplace_back(Vec3::Zero());
  s.integrator.step = 0.25;
  Ligament band;
  band.name = "band";
  band.law = law;
  band.path = {anchor("base", {0, 0, -0.004}), anchor("top", {0, 0, 0.004})};
  band.stiffness = 1000;
  s.ligaments = {band};
  Simulation run(s);
  run.advance(1);
  return all_warnings(run);
}

TEST(RunWarnings, ALigamentThatWouldHaveTornIsTold) {
  using enum Ligament::Law;
  const std::string told = told_of_ligament(4.4e-3, Blankevoort);
  EXPECT_TRUE(has(told, "ligament `band` was stretched by 55 % at t = 0.5 s: most tear at 20"))
      << told;
  EXPECT_FALSE(has(told_of_ligament(3.6e-3, Blankevoort), "ligament"));
  EXPECT_FALSE(has(told_of_ligament(4.4e-3, Linear), "ligament"));  // a spring
}

/// A block of the law "corotated" on three planes of symmetry. From half of its modulus on its free
/// faces fold, and it flips through its supports.
Scenario block_that_buckles(double push = 1e-6) {
  constexpr double kSide = 0.01, kYoung = 15e3;
  Scenario s = scene(0.1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide),
                       Vec3::Constant(kSide / 2), {2, 2, 2})};
  s.bodies[0].material = material_of(fem::Corotated(kYoung, 0));
  for (int k = 0; k < 3; ++k) {
    Support plane;
    plane.body = "block";
    const Vec3 high = Vec3::Ones() - (1 - 1e-6) * Vec3::Unit(k);
    plane.region.box = {Vec3::Constant(-1), high};
    plane.held = Vec3::Unit(k);
    s.supports.push_back(plane);
  }
  SurfaceLoad load;
  load.at = {"block", {}};
  load.at.region.box = {Vec3(-1, -1, kSide * (1 - 1e-6)), Vec3::Ones()};
  load.stress = Vec3(0, 0, -kYoung);
  load.profile = {{0, 1}, {0, 1}};
  // Without a push it would stand on the top of the hill, exactly.
  s.loads = {load, ForceLoad{anchor("block", Vec3::Constant(kSide)), {push, 0, 0}, {}, {}}};
  return s;
}

TEST(RunWarnings, ABlockThatBucklesIsToldWhereItDid) {
  Simulation run(block_that_buckles());
  run.advance(0.2);
  EXPECT_EQ(all_warnings(run), "");
  run.advance(0.8);
  const Snap& snap = run.state.extrema.snap;
  EXPECT_TRUE(has(all_warnings(run), "`block` buckled, or snapped through, in the load step to"))
      << all_warnings(run);
  EXPECT_GT(snap.motion, 0.01);
  EXPECT_NEAR(snap.expected, 1e-3, 5e-4);  // a tenth of its height
  EXPECT_GT(snap.loss, 0.5 * run.state.energy.load_work);
}

// At 6.9 of 15 kPa it stands, and at 12 only as nothing pushes it. A factorization sees that, and
// so do iterations.
TEST(RunWarnings, ABlockThatStandsOnTheTopOfAHillIsTold) {
  for (const auto solver : {Integrator::Solver::Cholesky, Integrator::Solver::ConjugateGradients})
    for (const double t : {0.46, 0.8}) {
      Scenario s = block_that_buckles(0);
      s.integrator.solver = solver;
      s.integrator.step = t;  // in several the round-off of iterations is a push
      Simulation run(s);
      run.advance(t);
      EXPECT_EQ(run.state.extrema.snap.body, -1);
      run.stepper.judge_stability();
      EXPECT_EQ(has(all_warnings(run), "the equilibrium at the end is not stable"), t > 0.6)
          << all_warnings(run);
    }
}

// Where no step can be made, what the summary is made from is that of the last one that was.
TEST(RunWarnings, AfterAFailureTheStepperIsBackAtTheLastState) {
  Scenario s = column(1e-3, Integrator::Scheme::ImplicitEuler);
  s.integrator.max_iterations = 1;  // too few for this tolerance, however short the step
  s.integrator.position_tolerance = 1e-15;
  s.loads = {gravity({0, 0, -1e5})};
  Simulation run(s);
  const double before = run.stepper.stored_energy().total();
  EXPECT_THROW(run.advance(0.1), SimulationError);
  EXPECT_EQ(run.state.t, 0);
  EXPECT_EQ(run.stepper.stored_energy().total(), before);
}

TEST(RunWarnings, WhatWentIntoAnotherBodyIsTold) {
  const Model model = build_model(column(1e-3, Integrator::Scheme::ImplicitEuler));
  const IgnoredOverlap overlap{0, 1, Vec3::Zero(), 3e-3, false, 0.02};
  EXPECT_TRUE(overlap_warnings(model, {}).empty());
  const std::vector<std::string> one = overlap_warnings(model, {overlap});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_TRUE(has(one[0], "`column` and `wall` went into each other, by 3 mm at t = 0.02 s"))
      << one[0];
  EXPECT_EQ(overlap_warnings(model, std::vector(4, overlap)).size(), 4U);
  const std::vector<std::string> many = overlap_warnings(model, std::vector(9, overlap));
  ASSERT_EQ(many.size(), 5U);
  EXPECT_TRUE(has(many[4], "5 more pairs")) << many[4];
}

// A mass on a stretched ligament, with steps so long that it creeps home: it never moves as fast as
// the ligament's energy would make it.
TEST(RunWarnings, OfWhatWasStrainedAtTheStartNoMoreThanAllIsLost) {
  Scenario s = scene(2e-3, Integrator::Scheme::ImplicitEuler);
  s.bodies = {mass_body("mass", 0.1, {0.012, 0, 0}), stand("wall")};
  Ligament ligament;
  ligament.name = "spring";
  ligament.path = {anchor("mass", {0.012, 0, 0}), anchor("wall", Vec3::Zero())};
  ligament.law = Ligament::Law::Linear;
  ligament.stiffness = 2000;
  ligament.slack_length = 0.01;
  s.ligaments = {ligament};
  Simulation run(s);
  run.advance(0.2);
  const std::string warnings = all_warnings(run);
  const std::size_t at = warnings.find(" J, ");
  ASSERT_NE(at, std::string::npos) << warnings;
  const double percent = std::stod(warnings.substr(at + 4));
  EXPECT_GT(percent, 80) << warnings;
  EXPECT_LE(percent, 100) << warnings;
}

}  // namespace articular::sim::run_warnings_test
