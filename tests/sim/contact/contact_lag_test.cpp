// Detection that looks anew only when things have moved (detection.lagged).
#include <gtest/gtest.h>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_lag_test {

constexpr double kSide = 0.02, kStep = 1e-3;  // [m], [s]

/// A soft cube 1 mm above a larger one.
Scenario falling_cube(bool lagged, Integrator::Scheme scheme) {
  Scenario s = contact_scene(kStep, scheme);
  s.bodies = {
      box_body("lower", Body::Kind::Tissue, {0.03, 0.03, kSide}, {0, 0, -kSide / 2}, {5, 5, 3}),
      box_body("upper", Body::Kind::Tissue, Vec3::Constant(kSide),
               {0.001, 0.002, 0.001 + kSide / 2}, {3, 3, 3}),
      stand("floor")};
  for (std::size_t b : {0U, 1U}) s.bodies[b].material->mass_damping = 50;  // [1/s]
  s.attachments = {attach("lower", "floor", {-1, -1, -1}, {1, 1, 1e-6 - kSide})};
  s.loads = {gravity({0, 0, -9.81})};
  s.detection.lagged = lagged;
  return s;
}

class LaggedDetection : public testing::TestWithParam<Integrator::Scheme> {};

// It falls, bounces and comes to rest: everything is where it is when each step looks, to far less
// than the depth of the contact, and when it rests hardly a step looks.
TEST_P(LaggedDetection, IsThatOfEveryStepAndRestsWithTheBodies) {
  Simulation each(falling_cube(false, GetParam())), lagged(falling_cube(true, GetParam()));
  double deepest = 0, farthest = 0;
  for (const double until : {0.02, 0.05, 0.3}) {
    each.advance(until);
    lagged.advance(until);
    deepest = std::max(deepest, each.state.max_penetration);
    farthest = std::max(farthest, (nodes_of(each, 1) - nodes_of(lagged, 1)).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(deepest, 1e-6);
  EXPECT_LT(farthest, 1e-3 * deepest);
  EXPECT_EQ(each.state.counts.lagged_steps, 0);
  EXPECT_EQ(each.state.counts.tree_updates, 2 * each.state.counts.steps);

  const Counts before = lagged.state.counts;
  lagged.advance(0.4);
  EXPECT_GT(lagged.state.counts.lagged_steps - before.lagged_steps, 90);
  EXPECT_LT(lagged.state.counts.tree_updates - before.tree_updates, 20);
  EXPECT_LT(lagged.state.counts.tree_updates, each.state.counts.tree_updates / 3);
}

INSTANTIATE_TEST_SUITE_P(Schemes, LaggedDetection,
                         testing::Values(Integrator::Scheme::ImplicitEuler,
                                         Integrator::Scheme::TrBdf2),
                         [](const auto& scheme) {
                           return scheme.param == Integrator::Scheme::TrBdf2 ? "TrBdf2"
                                                                             : "ImplicitEuler";
                         });

// A plate comes down at ten elements a second: what was found in earlier steps serves for a few,
// and the press is the same.
TEST(LaggedDetection, LooksAnewBeforeThingsHaveMovedByItsMargin) {
  const auto pressed = [](bool lagged) {
    Scenario s = contact_scene(kStep);
    s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), Vec3::Zero(),
                         Eigen::Vector3i::Constant(4)),
                box_body("plate", Body::Kind::Fixed, {0.03, 0.03, 0.006},
                         {0.001, 0, kSide / 2 + 0.0035}, {5, 5, 1}),
                stand("stand")};
    s.attachments = {attach("block", "stand", {-1, -1, -1}, {1, 1, 1e-9 - kSide / 2})};
    s.loads = {shift("plate", 0.08, {0, 0, -0.004})};
    s.detection.lagged = lagged;
    auto run = std::make_unique<Simulation>(s);
    run->advance(0.08);
    return run;
  };
  const auto each = pressed(false), lagged = pressed(true);
  const double force = each->force_on(bone_of(*each, "plate")).z();
  EXPECT_GT(force, 0.1);
  EXPECT_NEAR(lagged->force_on(bone_of(*lagged, "plate")).z(), force, 1e-3 * force);
  EXPECT_GT(lagged->state.counts.lagged_steps, 20);
  EXPECT_GT(lagged->state.counts.tree_updates, 10);
}

}  // namespace articular::sim::contact_lag_test
