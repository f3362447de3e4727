// Slopes of states by excitations, against differences of whole runs with other excitations. Runs
// are balanced to 1e-6 of their forces, and are taken 0.02 apart: differences are known to 1e-3.
#include "sim/step/state_response.hpp"

#include <gtest/gtest.h>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::state_response_test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kApart = 0.02, kTolerance = 2e-3;

Muscle line_muscle(const std::string& name, const Anchor& origin, const Anchor& insertion) {
  Muscle muscle;
  muscle.name = name;
  muscle.path = {origin, insertion};
  muscle.max_force = 0.5;
  return muscle;
}

/// A bone on a block of tissue that two muscles bend. One of them is 30 % longer than its optimum:
/// on the descending part of force-length, which Newton's matrix leaves out.
Scenario bone_on_a_block() {
  Scenario s = scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.02, 0.02, 0.04}, {0, 0, 0.02}, {2, 2, 4}),
              stand("floor"), mass_body("bone", 0.02, {0, 0, 0.05}, Vec3(1e-6, 2e-6, 1e-6))};
  s.attachments = {attach("block", "floor", {-1, -1, -1e-4}, {1, 1, 1e-4}),
                   attach("block", "bone", {-1, -1, 0.0399}, {1, 1, 0.0401})};
  s.muscles = {
      line_muscle("front", anchor("floor", {0, -0.03, 0}), anchor("bone", {0, -0.02, 0.05})),
      line_muscle("side", anchor("floor", {0.05, 0, 0}), anchor("bone", {0.01, 0, 0.05}))};
  s.muscles[1].optimal_length = 0.05;
  return s;
}

/// Tissue on a table, with a muscle that draws its top down and one that draws it aside.
Scenario block_on_a_table() {
  Scenario s = scene(1);
  s.contact = true;
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.02, 0.02, 0.02}, {0, 0, 0.01}, {3, 3, 3}),
              box_body("table", Body::Kind::Fixed, {0.04, 0.04, 0.01}, {0, 0, -0.005}, {2, 2, 1}),
              stand("wall")};
  s.attachments = {attach("block", "wall", {-1, -1, 0.0199}, {-0.0099, 1, 0.0201})};
  s.contacts = {{"block", "table", {}}};
  s.muscles = {
      line_muscle("down", anchor("wall", {0, 0, -0.02}), anchor("block", {0, 0, 0.02}, 0.006)),
      line_muscle("aside", anchor("wall", {0.05, 0, 0.02}),
                  anchor("block", {0.01, 0, 0.02}, 0.006))};
  return s;
}

Scenario at(Scenario s, const VectorXd& excitation, Scenario::Analysis analysis) {
  s.analysis = analysis;
  for (std::size_t m = 0; m < s.muscles.size(); ++m)
    s.muscles[m].excitation = {{0}, {excitation[static_cast<Index>(m)]}};
  return s;
}

/// Of free nodes, then of rigid bodies' centres.
VectorXd places(const Model& model, const VectorXd& y) {
  VectorXd x(3 * (model.layout.num_free_nodes + model.layout.num_rigid));
  x.head(3 * model.layout.num_free_nodes) = y.head(3 * model.layout.num_free_nodes);
  for (int r = 0; r < model.layout.num_rigid; ++r)
    x.segment<3>(3 * (model.layout.num_free_nodes + r)) = y.segment<3>(model.layout.rigid_p(r));
  return x;
}

/// What is compared: places, and tensions of the lines.
VectorXd shown(const Simulation& run, const VectorXd& y) {
  const VectorXd x = places(run.model, y);
  VectorXd all(x.size() + static_cast<Index>(run.model.lines.size()));
  all.head(x.size()) = x;
  for (std::size_t l = 0; l < run.model.lines.size(); ++l)
    all[x.size() + static_cast<Index>(l)] = run.stepper.now().lines[l].tension;
  return all;
}

MatrixXd slopes_by_response(Simulation& run, const StateResponse& response) {
  const Index inputs = response.activation.cols();
  MatrixXd slopes(shown(run, run.state.y).size(), inputs);
  for (Index j = 0; j < inputs; ++j) {
    const NearbyStates nearby = nearby_states(run.model, run.state.y, response, j);
    run.stepper.look_at(run.state, nearby.above);
    slopes.col(j) = shown(run, nearby.above);
    run.stepper.look_at(run.state, nearby.below);
    slopes.col(j) -= shown(run, nearby.below);
    slopes.col(j) /= nearby.apart;
  }
  run.stepper.look_at(run.state, run.state.y);
  return slopes;
}

MatrixXd slopes_by_runs(const Scenario& s, const VectorXd& excitation, Scenario::Analysis analysis,
                        double until) {
  MatrixXd slopes;
  for (Index j = 0; j < excitation.size(); ++j) {
    const VectorXd half = 0.5 * kApart * VectorXd::Unit(excitation.size(), j);
    Simulation above(at(s, excitation + half, analysis)), below(at(s, excitation - half, analysis));
    above.advance(until);
    below.advance(until);
    const VectorXd slope = (shown(above, above.state.y) - shown(below, below.state.y)) / kApart;
    slopes.conservativeResize(slope.size(), excitation.size());
    slopes.col(j) = slope;
  }
  return slopes;
}

/// Places and tensions each by their own size.
void expect_alike(const MatrixXd& found, const MatrixXd& expected, Index num_lines,
                  double tolerance = kTolerance) {
  const Index num_places = found.rows() - num_lines;
  for (Index j = 0; j < found.cols(); ++j) {
    const auto places_off = (found - expected).col(j).head(num_places).norm();
    const auto tensions_off = (found - expected).col(j).tail(num_lines).norm();
    EXPECT_LT(places_off, tolerance * expected.col(j).head(num_places).norm()) << "input " << j;
    EXPECT_LT(tensions_off, tolerance * expected.col(j).tail(num_lines).norm()) << "input " << j;
    EXPECT_GT(expected.col(j).head(num_places).norm(), 1e-4) << "input " << j;  // [m]
  }
}

class Statics : public ::testing::TestWithParam<Scenario (*)()> {};

TEST_P(Statics, ResponsesOfEquilibriaAreTheirDifferences) {
  const Scenario s = GetParam()();
  const VectorXd excitation = Eigen::Vector2d(0.4, 0.3);
  Simulation run(at(s, excitation, Scenario::Analysis::Static));
  run.advance(1);
  StateResponse response = no_response(run.model, 2);
  ASSERT_TRUE(run.stepper.follow(run.state, MatrixXd::Identity(2, 2), response));
  EXPECT_LT(response.error, 1e-3);
  expect_alike(slopes_by_response(run, response),
               slopes_by_runs(s, excitation, Scenario::Analysis::Static, 1), 2);
}

INSTANTIATE_TEST_SUITE_P(StateResponse, Statics,
                         ::testing::Values(bone_on_a_block, block_on_a_table));

// After twenty steps of implicit Euler, with all that activation, inertia and force-velocity do.
// Terms of second order in the bone's turn are left out.
TEST(StateResponse, IsCarriedThroughStepsInTime) {
  Scenario s = bone_on_a_block();
  s.integrator.position_tolerance = 1e-12;  // noise of twenty steps is then below that of forces
  const VectorXd excitation = Eigen::Vector2d(0.4, 0.3);
  // Activations begin below the excitations, and rise.
  const auto with = [&](const VectorXd& a) {
    Scenario made = at(s, a, Scenario::Analysis::Dynamic);
    for (Muscle& muscle : made.muscles)
      muscle.excitation = {{0, 1e-9}, {0, muscle.excitation.value[0]}};
    return made;
  };
  constexpr double kUntil = 0.02;
  Simulation run(with(excitation));
  StateResponse response = no_response(run.model, 2);
  run.advance(kUntil, [&] {
    ASSERT_TRUE(run.stepper.follow(run.state, MatrixXd::Identity(2, 2), response));
  });
  EXPECT_LT(response.error, 1e-3);
  const MatrixXd found = slopes_by_response(run, response);
  MatrixXd expected(found.rows(), 2);
  for (Index j = 0; j < 2; ++j) {
    const VectorXd half = 0.5 * kApart * VectorXd::Unit(2, j);
    Simulation above(with(excitation + half)), below(with(excitation - half));
    above.advance(kUntil);
    below.advance(kUntil);
    expected.col(j) = (shown(above, above.state.y) - shown(below, below.state.y)) / kApart;
  }
  expect_alike(found, expected, 2, 1e-2);
}

// At the bounds muscles don't pull any less or more: the slope is the one from within.
TEST(StateResponse, OfASilentMuscleIsThatOfABeginningPull) {
  const Scenario s = bone_on_a_block();
  Simulation silent(at(s, Eigen::Vector2d(0, 0), Scenario::Analysis::Static));
  silent.advance(1);
  StateResponse response = no_response(silent.model, 2);
  ASSERT_TRUE(silent.stepper.follow(silent.state, MatrixXd::Identity(2, 2), response));
  const MatrixXd found = slopes_by_response(silent, response);
  Simulation pulls(at(s, Eigen::Vector2d(1e-3, 0), Scenario::Analysis::Static));
  pulls.advance(1);
  const VectorXd expected = (shown(pulls, pulls.state.y) - shown(silent, silent.state.y)) / 1e-3;
  EXPECT_LT((found.col(0) - expected).norm(), 1e-2 * expected.norm());
}

}  // namespace articular::sim::state_response_test
