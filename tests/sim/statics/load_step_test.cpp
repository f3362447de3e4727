// Large load steps of a static analysis: where Newton's iteration begins, and what the ledger says.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sim/support/scene.hpp"

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

}  // namespace articular::sim::load_step_test
