// Bodies that overlap before anything has moved.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/contact/initial_overlap.hpp"
#include "sim/step/overlap_report.hpp"
#include "sim/step/overlap_resolution.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::overlap_resolution_test {

/// A block stands in another, 7/20 of its height deep.
Scenario block_in_block(double overlap = 7e-3) {
  Scenario s = contact_scene(1e-3);
  s.bodies = {stand("floor"),
              box_body("base", Body::Kind::Tissue, {0.04, 0.04, 0.02}, {0, 0, -0.01}, {8, 8, 4}),
              box_body("top", Body::Kind::Tissue, {0.018, 0.018, 0.02},
                       {6e-4, 8e-4, 0.01 - overlap}, {4, 4, 4})};
  s.attachments = {attach("base", "floor", {-1, -1, -0.0201}, {1, 1, -0.0199})};
  return s;
}

/// The state of a scene whose overlaps are resolved.
struct Settled {
  explicit Settled(const Scenario& scenario) : run(scenario), start(run.state.y) {
    resolution = resolve_overlaps(scenario, run.model, run.state.y);
    run.stepper.restart(run.state);
  }
  Simulation run;
  Eigen::VectorXd start;
  OverlapResolution resolution;
};

TEST(OverlapResolution, ABlockDeepInAnotherIsPushedOutUnstressed) {
  for (const auto analysis : {Scenario::Analysis::Dynamic, Scenario::Analysis::Static}) {
    Scenario s = block_in_block();
    s.analysis = analysis;
    Settled settled(s);
    ASSERT_EQ(settled.resolution.overlaps.size(), 1U);
    const double element = 0.02 / 4;
    EXPECT_NEAR(settled.resolution.overlaps[0].before, 7e-3, 1e-9);
    EXPECT_LT(settled.resolution.overlaps[0].after, 0.01 * element);
    EXPECT_NEAR(settled.resolution.largest_motion, 7e-3, 0.1 * 7e-3);
    EXPECT_GT(least_volume_ratio(settled.run), 0.9);
    const double lowest = nodes_of(settled.run, 1).row(2).minCoeff();
    EXPECT_NEAR(lowest, 0, 0.05 * element);
    // Next to what pressing it down again would take.
    EXPECT_LT(elastic_energy(settled.run.stepper.now()), 1e-2 * 20e3 * 0.018 * 0.018 * 7e-3);
  }
}

// The coarse facets of a cup cut into the finer head that lies in it with clearance everywhere. In
// statics the means around the nodes are open: there is nothing to settle, and it is no error.
TEST(OverlapResolution, FacetsThatCutIntoARoundBodyAreNoOverlapOfTheMeans) {
  constexpr double kRadius = 0.01, kClearance = 2.5e-4;  // [m]; the chords' sagitta is 3.3e-4
  const auto round = [](double radius, double lowest) {
    return [=](Vec3 X) {
      const double arc = radius - std::sqrt(radius * radius - X.x() * X.x());
      X.z() += arc + lowest;
      return X;
    };
  };
  const TemporaryFolder folder;
  Scenario s = contact_scene(1e-3);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {
      mesh_body("cup", Body::Kind::Tissue,
                bent({{0.01, 0.01, 0.004}, {2, 2, 2}, {0, 0, -0.002}}, round(kRadius, 0)), folder),
      mesh_body("head", Body::Kind::Rigid,
                bent({{0.012, 0.008, 0.004}, {24, 8, 4}, {0, 0, 0.002}},
                     round(kRadius - kClearance, kClearance)),
                folder),
      stand("floor")};
  s.attachments = {attach("cup", "floor", {-1, -1, -1}, {1, 1, -0.0025})};
  const Settled settled(s);
  const auto overlaps = initial_overlaps(settled.run.model);
  ASSERT_EQ(overlaps.size(), 1U);  // by the facets
  EXPECT_GT(overlaps[0].depth, settled.run.model.contacts[0].max_penetration);
  EXPECT_TRUE(settled.resolution.overlaps.empty());
  EXPECT_EQ(settled.resolution.largest_motion, 0);
}

TEST(OverlapResolution, VelocitiesAndActivationsStayAsTheyWere) {
  Scenario s = block_in_block();
  s.bodies[2].velocity = {0.1, 0.2, -0.3};
  s.loads = {gravity({0, 0, -9.81})};
  const Settled settled(s);
  const int velocities = settled.run.model.layout.velocities();
  const Eigen::Index rest = settled.start.size() - velocities;
  EXPECT_GT(settled.start.tail(rest).norm(), 0.1);
  EXPECT_EQ(settled.run.state.y.tail(rest), settled.start.tail(rest));
  EXPECT_GT((settled.run.state.y - settled.start).norm(), 1e-3);
}

// Gravity and other loads have no part in it: what does not overlap does not move.
TEST(OverlapResolution, WhatDoesNotOverlapDoesNotMove) {
  Scenario s = block_in_block(-1e-3);
  s.loads = {gravity({0, 0, -9.81})};
  const Settled settled(s);
  EXPECT_TRUE(settled.resolution.overlaps.empty());
  EXPECT_EQ(settled.run.state.y, settled.start);
}

// A fixed ball, an element and a half deep in tissue that is held below: the tissue gives way and
// keeps the stress; nothing is left inside the ball.
TEST(OverlapResolution, TissueAroundABoneThatCannotGiveWayKeepsTheStress) {
  constexpr double kElement = 4e-3;  // [m]
  Scenario s = contact_scene(1e-3);
  s.bodies = {stand("floor"),
              box_body("base", Body::Kind::Tissue, {0.04, 0.04, 0.02}, {0, 0, -0.01}, {10, 10, 5}),
              Body{}};
  s.attachments = {attach("base", "floor", {-1, -1, -0.0201}, {1, 1, -0.0199})};
  Body& ball = s.bodies[2];
  ball.name = "ball";
  ball.kind = Body::Kind::Fixed;
  ball.geometry = SphereGeometry{0.01, 3e-3, {0, 0, 0.004}};
  // Balanced: a step in time hardly moves it; with averages, which let facets sink in where points
  // of them were out, by a part of an element.
  for (const auto& [response, way] : {std::pair(Scenario::Response::Pointwise, 5e-3 * kElement),
                                      std::pair(Scenario::Response::Averaged, 0.1 * kElement)}) {
    s.contact_response = response;
    Settled settled(s);
    ASSERT_EQ(settled.resolution.overlaps.size(), 1U);
    EXPECT_NEAR(settled.resolution.overlaps[0].before, 6e-3, 0.3e-3);
    EXPECT_LT(settled.resolution.overlaps[0].after, 0.15 * kElement);
    const ContactId ball_in_base = settled.run.model.contacts.between(1, 2).value();
    EXPECT_GT(settled.run.stepper.dynamics().contact_summary(ball_in_base).force.norm(), 0.1);
    EXPECT_GT(least_volume_ratio(settled.run), 0.2);
    const Eigen::VectorXd before = settled.run.state.y;
    settled.run.advance(5e-3);
    const int positions = settled.run.model.layout.velocities();
    EXPECT_LT((settled.run.state.y - before).head(positions).lpNorm<Eigen::Infinity>(), way);
  }
}

// All but its top lies in the other: nearer to the upper side than to the lower one.
TEST(OverlapResolution, ABodyThatHardlyLooksOutOfAnotherFindsTheNearestWayOut) {
  Scenario s = block_in_block();
  s.bodies[2].geometry = BoxGeometry{{6e-3, 6e-3, 6e-3}, {3, 3, 3}, {0, 0, -2.9e-3}};
  const Settled settled(s);
  ASSERT_EQ(settled.resolution.overlaps.size(), 1U);
  EXPECT_NEAR(settled.resolution.overlaps[0].before, 5.9e-3, 1e-4);
  EXPECT_LT(settled.resolution.overlaps[0].after, 0.01 * 2e-3);
  const double lowest = nodes_of(settled.run, 1).row(2).minCoeff();
  EXPECT_GT(lowest, -1e-3);
}

// A rod through the middle of a block that is a surface alone: below the shell contact finds
// nothing.
TEST(OverlapResolution, ABodyThatCannotFindTheWayOutIsRefused) {
  const TemporaryFolder folder;
  Scenario s = contact_scene(1e-3);
  const MeshData solid = box_mesh({{0.1, 0.1, 0.1}, {20, 20, 20}, {0, 0, 0}});
  MeshData skin;
  skin.X = solid.X;
  skin.triangles = collision::build_surface(solid.tets, static_cast<int>(solid.X.cols())).faces;
  s.bodies = {mesh_body("large", Body::Kind::Fixed, skin, folder),
              box_body("small", Body::Kind::Tissue, {0.02, 0.02, 0.06}, {0, 0, 0.04}, {1, 1, 3})};
  Simulation run(s);
  try {
    resolve_overlaps(s, run.model, run.state.y);
    FAIL();
  } catch (const SimulationError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("`large` and `small` overlap at the start by "), 0U) << message;
    EXPECT_NE(message.find("move one of them"), std::string::npos) << message;
  }
}

// Bone does not give way: a hundredth of an element would hold the energy of a throw of metres.
TEST(OverlapResolution, RigidBodiesAreSetApartToRoundOffAndNothingFliesOff) {
  for (const double overlap : {1e-3, 1e-5}) {
    Scenario s = contact_scene(1e-5);
    s.bodies = {box_body("floor", Body::Kind::Fixed, {0.04, 0.04, 0.01}, {0, 0, -0.005}, {4, 4, 1}),
                box_body("brick", Body::Kind::Rigid, {0.02, 0.02, 0.01}, {0, 0, 0.005 - overlap},
                         {3, 3, 2})};
    s.loads = {gravity({0, 0, -9.81})};
    Settled settled(s);
    ASSERT_EQ(settled.resolution.overlaps.size(), 1U);
    EXPECT_NEAR(settled.resolution.overlaps[0].before, overlap, 1e-9);
    EXPECT_LT(settled.resolution.overlaps[0].after, 1e-8);
    settled.run.advance(0.01);
    const double height = settled.run.state.y[2];
    EXPECT_NEAR(height, 0.005, 1e-8);
  }
}

// `check` prints these, and `run` tells them.
TEST(OverlapReport, SaysOfEachOverlapWhatRunDoes) {
  const auto words_of = [](double overlap) {
    const Scenario s = block_in_block(overlap);
    const Simulation run(s);
    const auto reports = overlap_reports(s, run.model, run.state.y);
    return reports.empty() ? std::string() : reports.front().words;
  };
  EXPECT_EQ(words_of(-1e-3), "");
  EXPECT_EQ(words_of(0), "");
  EXPECT_EQ(words_of(1e-3).find("`base` and `top` overlap at the start by 1 mm, at ("), 0U);
  EXPECT_NE(words_of(1e-3).find(": `run` sets them apart first"), std::string::npos);
  const std::string mistake = "expected bodies that do not overlap";
  EXPECT_EQ(words_of(1e-3).find(mistake), std::string::npos);
  EXPECT_NE(words_of(4e-3).find(mistake), std::string::npos);
  EXPECT_EQ(words_of(1e-6).find("`base` and `top` overlap at the start by 0.001 mm"), 0U);
  EXPECT_NE(words_of(1e-6).find(": `run` starts so, pressed together"), std::string::npos);
}

// One element a side: no node of either lies inside the other.
TEST(OverlapResolution, AMicrometreOfOverlapIsFoundAndSurfacesThatLieFlushHaveNone) {
  constexpr double kDepth = 1e-6;  // [m]
  for (const double depth : {kDepth, 0.0}) {
    Scenario s = contact_scene(1e-3);
    s.bodies = {box_body("lower", Body::Kind::Tissue, Vec3::Constant(0.01), Vec3::Zero()),
                box_body("upper", Body::Kind::Tissue, Vec3::Constant(0.01), {0, 0, 0.01 - depth})};
    const Simulation run(s);
    const auto overlaps = overlaps_at_start(s, run.model, run.state.y);
    if (depth == 0) {
      EXPECT_TRUE(overlaps.empty());
      continue;
    }
    ASSERT_EQ(overlaps.size(), 1U);
    EXPECT_NEAR(overlaps[0].depth, kDepth, 1e-3 * kDepth);
    EXPECT_FALSE(overlaps[0].is_set_apart);  // less than 1/100 of an element
  }
}

}  // namespace articular::sim::overlap_resolution_test
