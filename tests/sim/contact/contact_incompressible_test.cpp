// A rigid sphere that is pressed into nearly incompressible tissue and dragged, in time.
#include <gtest/gtest.h>

#include "fem/material/any_material.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_incompressible_test {

constexpr double kStep = 1e-3, kPressed = 0.015, kEnd = 0.03;  // [s]
constexpr double kDepth = 0.5e-3, kWay = 5e-3;                 // [m]

/// A tenth deep into a block with a bulk modulus of fifty shear moduli, and over two cells of it.
Scenario dragged() {
  Scenario s = contact_scene(kStep);
  Body ball = ball_body(1000, {5e-3, 1.5e-3, {-4e-3, 0, 10e-3}});
  ball.kind = Body::Kind::Fixed;
  ball.density.reset();
  s.bodies = {
      stand("floor"), ball,
      box_body("block", Body::Kind::Tissue, {0.02, 0.01, 0.005}, {0, 0, 0.0025}, {8, 4, 3})};
  s.bodies[2].material = material_of(fem::MooneyRivlin<>(5e3, 0, 500e3));
  s.bodies[2].material->element = TissueMaterial::Element::Smoothed;
  s.attachments = {attach("block", "floor", {-1, -1, -1e-6}, {1, 1, 1e-6})};
  MotionLoad load;
  load.body = "ball";
  load.motion.time = {0, kPressed, kEnd};
  load.motion.translation = {Vec3::Zero(), {0, 0, -kDepth}, {kWay, 0, -kDepth}};
  s.loads = {load};
  ContactPair pair;
  pair.a = "ball";
  pair.b = "block";
  s.contacts = {pair};
  return s;
}

// Contact that went by the constrained modulus took twenty iterations a step here, and cut steps
// where the bulk modulus is larger.
TEST(ContactIncompressible, ADraggedSphereCutsNoStepAndTakesFewIterations) {
  Simulation run(dragged());
  run.advance(kEnd);
  EXPECT_EQ(run.state.counts.rejected_newton, 0);
  EXPECT_LE(run.state.counts.steps, 32);
  EXPECT_LE(run.state.counts.newton_iterations, 8 * run.state.counts.steps);
  EXPECT_GT(run.force_on(bone_of(run, "ball")).z(), 0.02);  // [N]
}

}  // namespace articular::sim::contact_incompressible_test
