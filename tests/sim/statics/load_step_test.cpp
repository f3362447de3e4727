// Large load steps of a static analysis: where Newton's iteration begins, and what the ledger says.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::load_step_test {

constexpr double kWay = 0.03;  // three elements of the bar [m]

/// A bar between a floor and a wall that goes up or down by three elements.
Scenario driven_bar(double step, const Vec3& way) {
  Scenario s = scene(step);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.02, 0.02, 0.08}, {0, 0, 0.04}, {2, 2, 8}),
              stand("wall"), stand("floor")};
  s.attachments = {attach("bar", "wall", {-1, -1, 0.0799}, {1, 1, 0.0801}),
                   attach("bar", "floor", {-1, -1, -1e-4}, {1, 1, 1e-4})};
  s.loads = {shift("wall", 1, way)};
  return s;
}

Positions bar_nodes(const Simulation& run) {
  Positions x;
  positions_of(run.now(), run.model.tissues[0].nodes, x);
  return x;
}

TEST(LoadStep, AWallMayMoveByElementsInOneStep) {
  for (const Vec3& way : {Vec3(0, 0, kWay), Vec3(0, 0, -kWay), Vec3(kWay, 0, 0)}) {
    Simulation at_once(driven_bar(1, way)), slowly(driven_bar(0.05, way));
    at_once.advance(1);
    slowly.advance(1);
    EXPECT_EQ(at_once.state.counts.rejected_newton, 0) << way.transpose();
    EXPECT_EQ(at_once.state.counts.steps, 1) << way.transpose();
    EXPECT_LT((bar_nodes(at_once) - bar_nodes(slowly)).colwise().norm().maxCoeff(), 1e-4 * kWay)
        << way.transpose();
  }
}

/// The bar, and a block that falls by 2 mm onto the ground: pseudo-time carries it.
Scenario bar_beside_a_falling_block(const Vec3& way) {
  Scenario s = driven_bar(1, way);
  s.contact = true;
  s.bodies.push_back(
      box_body("block", Body::Kind::Tissue, {0.01, 0.01, 0.01}, {0.5, 0, 0.007}, {3, 3, 3}));
  s.bodies.push_back(
      box_body("ground", Body::Kind::Fixed, {0.04, 0.04, 0.004}, {0.5, 0, -0.002}, {3, 3, 1}));
  s.contacts = {{"block", "ground", {}}};
  s.loads.push_back(gravity({0, 0, -9.81}));
  return s;
}

// What pseudo-time takes is no more when a wall squeezes a bar beside it: the squeeze is work that
// the bar stores.
TEST(LoadStep, PseudoTimeTakesNothingOfTheWorkOfADrivenWall) {
  Simulation at_rest(bar_beside_a_falling_block(Vec3::Zero()));
  Simulation driven(bar_beside_a_falling_block({0, 0, -0.5 * kWay}));
  at_rest.advance(1);
  driven.advance(1);
  const double work = driven.state.energy.motion_work;
  EXPECT_GT(work, 0.01);  // [J]
  EXPECT_NEAR(driven.state.energy.settling_loss, at_rest.state.energy.settling_loss, 1e-3 * work);
  EXPECT_GT(driven.loss(), -1e-3 * work);
}

// Where the first guess of a load step has high pressures, only these hold the bar together. Fixed
// bodies hold both its ends: no detour by pseudo-time as if it were loose, and no warning.
TEST(LoadStep, SmoothedTissueThatIsHeldAtBothEndsIsNotLoose) {
  Scenario s = driven_bar(0.1, {0, 0, 0.16});
  s.bodies[0].material = neo_hookean(20e3, 0.4999);
  s.bodies[0].material->element = TissueMaterial::Element::Smoothed;
  Simulation run(s);
  run.advance(0.3);
  EXPECT_EQ(run.state.energy.settling_loss, 0);
  EXPECT_TRUE(run.stepper.indifferent().empty());
}

constexpr double kValley = 0.1, kBall = 5e-3;  // radii [m]

/// A ball with an elastic layer in the valley z = x²/2R, pressed down with 10 N and aside with a
/// tenth of it.
Scenario ball_in_a_valley(const TemporaryFolder& folder) {
  Scenario s = contact_scene(1);
  s.analysis = Scenario::Analysis::Static;
  const MeshData valley = bent({{0.2, 0.04, 0.004}, {60, 4, 1}, {0, 0, -0.002}}, [](const Vec3& X) {
    return Vec3(X.x(), X.y(), X.z() + 0.5 * X.x() * X.x() / kValley);
  });
  Body ball = ball_body(1000, {kBall, 1e-3, {0, 0, kBall}});
  ball.layer = Layer{1e-3, 5e6, 0.3};
  ball.hold.emplace().held = {false, true, false, true, true, true};
  s.bodies = {ball, mesh_body("valley", Body::Kind::Fixed, valley, folder)};
  s.loads = {ForceLoad{anchor("ball", {0, 0, kBall}), {1, 0, -10}, {}, {}}};
  return s;
}

// It rests where the valley is as steep as the force, far beyond what was found when it began:
// contacts are found as the iteration goes on.
TEST(LoadStep, ABodyMaySlideFarInOneStep) {
  const TemporaryFolder folder;
  Simulation run(ball_in_a_valley(folder));
  run.advance(1);
  const double slope = 0.1, x = slope * kValley - kBall * slope / std::hypot(1, slope);
  EXPECT_NEAR(run.now().poses[0].p.x(), x, 0.02 * x);
  EXPECT_EQ(run.state.counts.rejected_motion, 0);
  EXPECT_EQ(run.state.counts.rejected_newton, 0);
  EXPECT_LT(run.state.counts.newton_iterations, 60);
}

/// A ball on a block, pressed into it with 20 N.
Scenario ball_on_a_block(const TemporaryFolder& folder) {
  Scenario s = contact_scene(1);
  s.analysis = Scenario::Analysis::Static;
  const MeshData block =
      bent({{0.06, 0.06, 0.02}, {12, 12, 4}, {0, 0, -0.01}}, [](const Vec3& X) { return X; });
  Body ball = ball_body(1000, {0.02, 3e-3, {0, 0, 0.02}});
  ball.hold.emplace().held = {true, true, false, true, true, true};
  s.bodies = {ball, mesh_body("block", Body::Kind::Tissue, block, folder), stand("floor")};
  s.bodies[1].material = neo_hookean(50e3, 0.4);
  s.attachments = {attach("block", "floor", {-1, -1, -0.0201}, {1, 1, -0.0199})};
  s.loads = {ForceLoad{anchor("ball", {0, 0, 0.02}), {0, 0, -20}, {}, {}}};
  return s;
}

// Contact spreads from one node to a hundred. Where nothing is foreseen of it, corrections end
// where the next nodes begin to press.
TEST(LoadStep, ContactSpreadsFarInFewIterations) {
  const TemporaryFolder folder;
  Simulation run(ball_on_a_block(folder));
  run.advance(1);
  EXPECT_EQ(run.state.counts.rejected_newton, 0);
  EXPECT_LT(run.state.counts.newton_iterations, 17);
  // Matrices that others make afterwards are of what presses.
  for (const ContactPairState* pair_state : run.stepper.dynamics().now().contact.pair_states())
    EXPECT_TRUE(pair_state->foreseen.empty());
}

}  // namespace articular::sim::load_step_test
