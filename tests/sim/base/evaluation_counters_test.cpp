// Model only what a scene requires: what it does not name is never evaluated.
#include "sim/base/evaluation_counters.hpp"
#include "fem/material/any_material.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/sim/support/scene.hpp"

namespace articular::sim::evaluation_counters_test {

using Names = std::set<std::string>;

EvaluationCounts evaluations(const Scenario& scenario, int steps = 2) {
  Simulation run(scenario);
  for (int k = 0; k < steps; ++k) run.stepper.step(run.state, 1);
  return run.stepper.evaluations();
}

/// The terms that were evaluated in two steps and at the start.
Names evaluated(const Scenario& scenario) {
  const EvaluationCounts counts = evaluations(scenario);
  Names names;
  for (std::size_t i = 0; i < kNumTerms; ++i)
    if (counts[static_cast<Term>(i)] > 0) names.emplace(name_of(static_cast<Term>(i)));
  return names;
}

/// A bar of tissue that grows on a wall and moves on its own.
Scenario bar() {
  Scenario s = scene(1e-3);
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.01, 0.01, 0.04}, Vec3::Zero(), {2, 2, 4}),
              stand("wall")};
  s.bodies[0].velocity = {0.1, 0, 0};
  s.attachments = {attach("bar", "wall", {-1, -1, -1}, {1, 1, -0.0199})};
  return s;
}

const Names kBar = {"elastic_force", "elastic_stiffness", "inertia"};

Names with(Names names, const Names& more) {
  names.insert(more.begin(), more.end());
  return names;
}

Muscle line_muscle() {
  Muscle muscle;
  muscle.name = "line";
  muscle.path = {anchor("wall", {0, 0, -0.02}), anchor("bar", {0, 0, 0.02})};
  muscle.max_force = 0.01;
  return muscle;
}

TEST(Terms, ATissueAloneIsElasticityAndInertia) { EXPECT_EQ(evaluated(bar()), kBar); }

TEST(Terms, EquilibriumHasNoInertia) {
  Scenario s = bar();
  s.analysis = Scenario::Analysis::Static;
  s.bodies[0].velocity.setZero();
  s.loads = {gravity({0, 0, -1})};
  EXPECT_EQ(evaluated(s), (Names{"elastic_force", "elastic_stiffness", "gravity"}));
}

TEST(Terms, WhatActsOnItIsEvaluatedWhereItIsNamedAndNowhereElse) {
  Scenario s = bar();
  s.loads = {gravity({0, 0, -1})};
  EXPECT_EQ(evaluated(s), with(kBar, {"gravity"}));

  s = bar();
  ForceLoad force;
  force.at = anchor("bar", {0, 0, 0.02});
  force.force = {0, 0, 1e-3};
  s.loads = {force};
  EXPECT_EQ(evaluated(s), with(kBar, {"load"}));

  s = bar();
  Ligament ligament;
  ligament.name = "ligament";
  ligament.path = line_muscle().path;
  ligament.stiffness = 1;
  s.ligaments = {ligament};
  EXPECT_EQ(evaluated(s), with(kBar, {"ligament"}));

  s = bar();
  s.muscles = {line_muscle()};
  EXPECT_EQ(evaluated(s), with(kBar, {"line_muscle"}));
}

TEST(Terms, WhatATissueIsMadeOfIsEvaluatedWhereItIsNamedAndNowhereElse) {
  Scenario s = bar();
  s.bodies[0].material->mass_damping = 1;
  EXPECT_EQ(evaluated(s), with(kBar, {"tissue_damping"}));

  s = bar();
  s.bodies[0].material->stiffness_damping = 1e-3;
  EXPECT_EQ(evaluated(s), with(kBar, {"tissue_damping"}));

  s = bar();
  s.bodies[0].material->relaxation = {{.weight = 0.3, .time = 0.02}};
  EXPECT_EQ(evaluated(s), with(kBar, {"relaxation"}));

  s = bar();
  fem::BlemkerMuscle<fem::LogVolumeChange>::Constants ground;
  ground.c10 = 1e4;
  ground.kappa = 1e6;
  s.bodies[0].material =
      material_of(fem::BlemkerMuscle<>(fem::MuscleFibre(fem::MuscleFibre::Constants()), ground));
  s.bodies[0].material->fibres = Fibres{Vec3::UnitZ()};
  Muscle muscle;
  muscle.name = "fibres";
  muscle.tissue = "bar";
  s.muscles = {muscle};
  EXPECT_EQ(evaluated(s), with(kBar, {"fibre_muscle"}));
}

/// With a fixed plate above, at a distance from the bar's end.
Scenario under_a_plate(double gap) {
  Scenario s = bar();
  s.contact = true;
  s.bodies.push_back(
      box_body("plate", Body::Kind::Fixed, {0.04, 0.04, 0.01}, {0, 0, 0.025 + gap}, {4, 4, 1}));
  s.contacts = {{"bar", "plate", {}}};
  return s;
}

const Names kSearched = {"body_update", "fixed_body_update", "box_test"};
const Names kTouching = {"tree_fit", "pair_query", "contact_force", "contact_stiffness"};

TEST(Terms, BodiesWhoseBoxesHaveNotOverlappedCostOneComparison) {
  EXPECT_EQ(evaluated(under_a_plate(0.01)), with(kBar, kSearched));
  Simulation run(under_a_plate(0.01));
  for (int k = 0; k < 2; ++k) run.stepper.step(run.state, 1);
  EXPECT_EQ(run.state.counts.narrow_tests, 0);
  EXPECT_EQ(run.state.counts.evaluations[Term::BoxTest], 2);
}

TEST(Terms, BodiesThatTouchHaveForcesAndFrictionAndDampingWhereTheyAreNamed) {
  const Names touching = with(with(kBar, kSearched), kTouching);
  Scenario s = under_a_plate(-1e-5);
  EXPECT_EQ(evaluated(s), touching);
  s.contacts[0].friction = 0.2;
  EXPECT_EQ(evaluated(s), with(touching, {"friction"}));
  s.contacts[0].friction = 0;
  s.contacts[0].damping = 1e3;
  EXPECT_EQ(evaluated(s), with(touching, {"contact_damping"}));
}

TEST(Terms, AFixedBodyIsPlacedOnce) {
  const EvaluationCounts counts = evaluations(under_a_plate(0.01), 5);
  EXPECT_EQ(counts[Term::FixedBodyUpdate], 1);
  EXPECT_EQ(counts[Term::BodyUpdate], 6);  // at the start, and in each step
}

TEST(Terms, ABodyIsTestedAgainstItselfOnlyWhereTheSceneAsksForIt) {
  Scenario s = bar();
  s.contact = true;
  s.contacts = {{"bar", "bar", {}}};
  const Names self = evaluated(s);
  EXPECT_EQ(self.count("self_query"), 1U);
  EXPECT_EQ(self.count("box_test"), 0U);
  EXPECT_EQ(evaluated(under_a_plate(-1e-5)).count("self_query"), 0U);
}

TEST(Terms, FixedAndDrivenBodiesHaveNoUnknownsAndARigidOneHasSix) {
  Scenario s = under_a_plate(0.01);
  const int alone = Simulation(bar()).model.layout.num_unknown_blocks();
  EXPECT_EQ(Simulation(s).model.layout.num_unknown_blocks(), alone);
  s.loads = {shift("plate", 1, {0, 0, 1e-3})};
  EXPECT_EQ(Simulation(s).model.layout.num_unknown_blocks(), alone);
  s.loads.clear();
  s.bodies.back().kind = Body::Kind::Rigid;
  s.bodies.back().density = 1000;
  EXPECT_EQ(3 * Simulation(s).model.layout.num_unknown_blocks(), 3 * alone + 6);
}

TEST(Terms, WithoutContactNoBodyHasATree) {
  Scenario s = under_a_plate(-1e-5);
  s.contact = false;
  EXPECT_EQ(evaluated(s), kBar);
  const Simulation run(s);
  for (const BodyModel& body : run.model.bodies) EXPECT_FALSE(body.collider) << body.name;
}

}  // namespace articular::sim::evaluation_counters_test
