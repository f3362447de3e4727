#include "sim/lines/line_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/lines/wrapped_stiffness.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::line_path_test {
namespace {

constexpr double kRadius = 0.02, kStiffness = 400, kMass = 0.3;

Body ball(double element) {
  Body body = box_body("block", Body::Kind::Fixed, Vec3::Ones());
  body.geometry = SphereGeometry{kRadius, element, Vec3::Zero()};
  return body;
}

/// A mass hangs on a ligament over a block.
Scenario hanging(double step, Integrator::Scheme scheme) {
  Scenario s = scene(step, scheme);
  s.bodies = {box_body("block", Body::Kind::Fixed, Vec3(0.04, 0.06, 0.04), Vec3::Zero(), {4, 5, 4}),
              mass_body("mass", kMass, {0.0205, 0.002, -0.01}), stand("wall")};
  Ligament cord;
  cord.name = "cord";
  cord.path = {anchor("wall", {-0.05, 0.001, 0.015}), anchor("mass", {0.0205, 0.002, -0.01})};
  cord.wrap = {"block"};
  cord.stiffness = kStiffness;
  s.ligaments = {cord};
  s.loads = {gravity({0, 0, -9.81})};
  return s;
}

/// The block is a ball that turns about its middle.
Scenario hanging_over_a_free_ball() {
  Scenario s = hanging(1e-3, Integrator::Scheme::TrBdf2);
  s.bodies[0] = ball(0.006);
  s.bodies[0].kind = Body::Kind::Rigid;
  Hold hold;
  hold.held = {true, true, true, false, false, false};
  s.bodies[0].hold = hold;
  return s;
}

TEST(LinePath, StartsAroundTheBodyAndPullsOnIt) {
  const Simulation run(hanging(1e-3, Integrator::Scheme::TrBdf2));
  const Moment& now = run.stepper.now();
  ASSERT_EQ(now.paths.size(), 1U);
  EXPECT_GT(now.paths[0].strings[0].crossings.size(), 3U);  // one edge in each row of the top
  EXPECT_NEAR(now.lines[0].length, run.model.lines[0].start_length, 1e-12);
  // From edge to edge of the top.
  EXPECT_NEAR(contact_length(now.paths[0]), 0.04, 1e-4);
}

// Of each string the forces on all bodies add up to nothing, and so do their moments.
TEST(LinePath, PutsNoNetForceOrMomentOnTheScene) {
  Simulation run(hanging(1e-3, Integrator::Scheme::TrBdf2));
  run.advance(0.02);
  const auto path = path_of(run.stepper.now(), 0);
  Vec3 sum = Vec3::Zero();
  for (int r = 0; r < static_cast<int>(run.model.rigid_bodies.size()); ++r)
    sum += moment_of_line(path, run.now(), r, Vec3(0.1, -0.2, 0.3));
  EXPECT_LT(sum.norm(), 1e-15);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * run.model.num_blocks);
  add_line_force(path, run.now(), 100, f);
  Vec3 force = Vec3::Zero();
  for (const RigidBody& rigid : run.model.rigid_bodies) force += f.segment<3>(3 * rigid.block);
  EXPECT_LT(force.norm(), 1e-12);
}

/// Columns: what the forces on unknown blocks are, less by, when a block moves.
TEST(LinePath, StiffnessIsTheDerivativeOfTheForce) {
  const Simulation run(hanging_over_a_free_ball());
  const Model& model = run.model;
  const Line& line = model.lines[0];
  Configuration at = run.now();
  at.poses[static_cast<std::size_t>(model.bodies[1].rigid)].p += Vec3(0.005, 0.001, -0.01);
  const WrapHistory history = initial_wraps(model);
  const auto size = 3 * model.layout.num_unknown_blocks();
  const auto force = [&](const Configuration& where) {
    LinePath path;
    find_path(model, line, where, history, path);
    EXPECT_TRUE(path.found);
    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * model.num_blocks);
    add_line_force(path.points, where, line_state(model, line, path.points, where).tension, f);
    return Eigen::VectorXd(f.head(size));
  };
  LinePath path;
  find_path(model, line, at, history, path);
  const LineState state = line_state(model, line, path.points, at);
  ASSERT_GT(state.tension, 1);
  Stencils stencils;
  append_wrapped_stencil(model, line, stencils);
  fem::BlockMatrix A(model.layout.num_unknown_blocks(), stencils.blocks, stencils.offsets);
  A.set_zero();
  add_wrapped_stiffness(model, line, path, at, state, {0, 0, 1}, false, A);
  const double h = 1e-7;
  const int mass = model.rigid_bodies[static_cast<std::size_t>(model.bodies[1].rigid)].block;
  const auto turned = static_cast<std::size_t>(model.bodies[0].rigid);
  const int ball_block = model.rigid_bodies[turned].block;
  for (int k = 0; k < 6; ++k) {
    // The mass shifts, or the ball turns below the string.
    const auto moved = [&](double by) {
      Configuration where = at;
      if (k < 3)
        where.poses[static_cast<std::size_t>(model.bodies[1].rigid)].p[k] += by;
      else
        where.poses[turned].R = rotation_matrix(by * Vec3::Unit(k - 3)) * where.poses[turned].R;
      return force(where);
    };
    const Eigen::VectorXd slope = -(moved(h) - moved(-h)) / (2 * h);
    const int column = k < 3 ? mass : ball_block + 1;
    const Vec3 found = A.block(A.slot(mass, column)).col(k % 3);
    EXPECT_LT((found - slope.segment<3>(3 * mass)).norm(), 1e-4 * kStiffness * (k < 3 ? 1 : 0.02));
  }
}

/// The most energy that was lost or made at any time of a swing, as a part of what was turned over.
double drift(Scenario s, double step) {
  s.integrator.step = step;
  s.bodies[1].velocity = {0.3, 0.1, 0};
  Simulation run(s);
  double most = 0;
  run.advance(0.3, [&] { most = std::max(most, std::abs(run.loss())); });
  return most / (0.5 * kMass * 0.1 + std::pow(kMass * 9.81, 2) / kStiffness);
}

// No damper, no contact: what the scheme loses falls with its order, though edges come and go.
TEST(LinePath, ASwingingMassKeepsItsEnergy) {
  const Scenario s = hanging(1e-3, Integrator::Scheme::TrBdf2);
  const double coarse = drift(s, 2e-3), fine = drift(s, 5e-4);
  EXPECT_LT(coarse, 0.01);
  EXPECT_LT(fine, 0.1 * coarse);
}

// Over a ball it slides sideways and passes nodes, where it gets shorter at once by the square of
// the angle that is missing around a node: 5 um at most, of 2 mm elements.
TEST(LinePath, PassingNodesOfABallLosesLittleEnergy) {
  Scenario s = hanging(1e-3, Integrator::Scheme::TrBdf2);
  // Less than half around the ball: beyond that it would slide off.
  s.ligaments[0].path = {anchor("wall", {-0.05, 0.001, 0.01}),
                         anchor("mass", {0.05, 0.002, 0.005})};
  s.bodies[1].center_of_mass = Vec3(0.05, 0.002, 0.005);
  s.loads = {gravity({9.81, 0, 0})};
  s.bodies[0] = ball(0.006);
  EXPECT_LT(drift(s, 2.5e-4), 5e-3);
  s.bodies[0] = ball(0.002);
  EXPECT_LT(drift(s, 2.5e-4), 5e-3);
}

TEST(LinePath, ACopyOfTheStateGoesOnWithTheSameBits) {
  Scenario s = hanging(1e-3, Integrator::Scheme::TrBdf2);
  s.bodies[1].velocity = {0.3, 0.1, 0};
  Simulation run(s), other(s);
  run.advance(0.05);
  const State kept = run.state;
  run.stepper.restart(run.state);
  run.advance(0.1);
  State again = kept;
  other.stepper.restart(again);
  while (again.t < 0.1) other.stepper.step(again, 0.1);
  ASSERT_EQ(again.y.size(), run.state.y.size());
  for (Eigen::Index i = 0; i < again.y.size(); ++i) EXPECT_EQ(again.y[i], run.state.y[i]);
}

// The force downwards on the mass is its weight, and the string stays around the ball.
TEST(LinePath, StaticsHangsAMassOverABody) {
  Scenario s = hanging(1, Integrator::Scheme::TrBdf2);
  s.analysis = Scenario::Analysis::Static;
  Hold upright;  // nothing else would resist a turn
  upright.held = {false, false, false, true, true, true};
  s.bodies[1].hold = upright;
  s.ligaments[0].slack_extension = -1e-3;
  Simulation run(s);
  run.advance(1);
  const Moment& now = run.stepper.now();
  EXPECT_GT(now.paths[0].strings[0].crossings.size(), 0U);
  EXPECT_NEAR(now.lines[0].tension, kMass * 9.81, 1e-5 * kMass * 9.81);
}

TEST(LinePath, RefusesAPointDeepInsideWhatItWrapsAround) {
  Scenario s = hanging(1e-3, Integrator::Scheme::TrBdf2);
  s.ligaments[0].path[0] = anchor("wall", {0.001, 0, 0});
  EXPECT_THROW(Simulation{s}, InputError);
}

}  // namespace
}  // namespace articular::sim::line_path_test
