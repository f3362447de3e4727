// Where the iteration of a step in time starts.
#include <gtest/gtest.h>

#include <cstdint>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::stage_prediction_test {

/// A soft cube that falls onto a larger one, which it meets in the fifth step.
Scenario falling_cube() {
  constexpr double kUpper = 0.1, kLower = 0.2, kFall = 0.01;  // [m]
  Scenario s = contact_scene(0.01);
  s.bodies = {box_body("lower", Body::Kind::Tissue, Vec3::Constant(kLower), {0, 0, -kLower / 2},
                       Eigen::Vector3i::Constant(4)),
              box_body("upper", Body::Kind::Tissue, Vec3::Constant(kUpper),
                       {0, 0, kFall + kUpper / 2}, Eigen::Vector3i::Constant(2)),
              stand("floor")};
  for (std::size_t b : {0U, 1U}) s.bodies[b].material = neo_hookean(1e5, 0.45);
  s.attachments = {attach("lower", "floor", {-1, -1, -1}, {1, 1, -kLower + 1e-6})};
  s.loads = {gravity({0, 0, -9.81})};
  return s;
}

// The acceleration of the blow would lead the cube away in the next step, and the iteration from
// there back and deep into what it lies on: 12 and 34 iterations.
TEST(StagePrediction, TheStepsAfterABlowTakeFewIterations) {
  constexpr int kBlow = 6;  // steps until it is over
  Simulation run(falling_cube());
  std::int64_t before = 0;
  for (int step = 1; step <= 10; ++step) {
    run.advance(0.01 * step);
    const std::int64_t taken = run.state.counts.newton_iterations - before;
    before = run.state.counts.newton_iterations;
    if (step == kBlow) {
      EXPECT_GT(run.stepper.dynamics().contact_summary(0).force.norm(), 1);
    } else if (step > kBlow) {
      EXPECT_LE(taken, 5) << "step " << step;
    }
  }
  EXPECT_EQ(run.state.counts.steps, 10);
}

// A smoothed bar, nearly incompressible, that swings: 13 iterations a step of two stages. With
// pressures that follow the positions alone it would be 20.
TEST(StagePrediction, LongStepsOfNearlyIncompressibleTissueTakeFewIterations) {
  Scenario s = contact_scene(0.01, Integrator::Scheme::TrBdf2);
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.05, 5e-3, 5e-3}, {0.025, 0, 0}, {10, 1, 1}),
              stand("wall")};
  s.bodies[0].material = neo_hookean(1e5, 0.4999);
  s.bodies[0].material->element = TissueMaterial::Element::Smoothed;
  s.attachments = {attach("bar", "wall", {-1, -1, -1}, {1e-6, 1, 1})};
  s.bodies[0].velocity = {0, 0, 0.05};
  s.integrator.position_tolerance = 1e-9;
  Simulation run(s);
  run.advance(0.2);
  EXPECT_EQ(run.state.counts.rejected_newton, 0);
  EXPECT_LE(run.state.counts.newton_iterations, 14 * run.state.counts.steps);
}

}  // namespace articular::sim::stage_prediction_test
