// How far contact may penetrate, and the responses that a scenario may choose.
#include <gtest/gtest.h>

#include "sim/scenario/preset.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_bound_test {

constexpr double kSide = 0.1;  // [m]

/// A plate comes down on a block that stands on the floor, by a twentieth of its height.
Scenario pressed() {
  Scenario s = contact_scene(0.1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {
      box_body("floor", Body::Kind::Fixed, {0.2, 0.2, 0.02}, {0, 0, -0.01}),
      box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), {0, 0, kSide / 2}, {4, 4, 4}),
      box_body("plate", Body::Kind::Fixed, {0.2, 0.2, 0.02}, {0, 0, kSide + 0.01}, {3, 3, 1})};
  s.attachments = {attach("block", "floor", {-1, -1, -1e-3}, {1, 1, 1e-3})};
  s.loads = {shift("plate", 0.1, {0, 0, -kSide / 20})};
  ContactPair pair;
  pair.a = "block";
  pair.b = "plate";
  s.contacts = {pair};
  return s;
}

struct Press {
  double force = 0, depth = 0;  // [N], [m]
};

/// @param stiffness  of the contact [Pa/m], and
/// @param bound  on its mean depth [m]; none: by default
Press press(std::optional<double> stiffness = {}, std::optional<double> bound = {}) {
  Simulation run(pressed(), [&](Model& model) {
    if (stiffness) contact_stiffness_of (*stiffness)(model);
    if (bound)
      model.contacts.change(
          [most = *bound](ContactModel& contact) { contact.max_penetration = most; });
  });
  run.advance(0.1);
  const ContactSummary contact = run.stepper.dynamics().contact_summary(0);
  return {contact.force.norm(), contact.max_depth};
}

// Ten times as stiff as the block, a penalty lets the plate sink in by a tenth of the way; with a
// bound it presses as a stiff one.
TEST(MaxPenetration, MultipliersTakeOverWhatASoftPenaltyCannotCarry) {
  const double soft = 10 * 20e3 / kSide, bound = 1e-6;
  const Press stiff = press();
  const Press sunk = press(soft, 1.0);
  const Press bounded = press(soft, bound);
  EXPECT_GT(sunk.depth, 100 * bound);
  EXPECT_LT(sunk.force, 0.95 * stiff.force);
  EXPECT_LE(bounded.depth, bound);
  EXPECT_NEAR(bounded.force, stiff.force, 2e-3 * stiff.force);
}

// By default the bound is a hundredth of an element.
TEST(MaxPenetration, IsAHundredthOfAnElementInStatics) {
  const double element = kSide / 4;
  const Press sunk = press(20e3 / kSide);
  EXPECT_LE(sunk.depth, 0.0101 * element);
  EXPECT_GT(sunk.force, 0.95 * press().force);
}

/// A block dropped on a table from half its height.
Scenario dropped(Scenario::Response response) {
  Scenario s = contact_scene(2e-3);
  s.contact_response = response;
  s.bodies = {box_body("table", Body::Kind::Fixed, {0.3, 0.3, 0.1}, {0, 0, -0.05}, {3, 3, 1}),
              box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), {0, 0, kSide / 2 + 0.01},
                       {4, 4, 4})};
  s.bodies[1].material->mass_damping = 10;
  s.loads = {gravity({0, 0, -9.81})};
  return s;
}

// At rest: the weight, however depths count.
TEST(ContactResponses, CarryTheWeight) {
  const double weight = 1000 * kSide * kSide * kSide * 9.81;
  for (const auto response : {Scenario::Response::Pointwise, Scenario::Response::Averaged}) {
    Simulation run(dropped(response));
    EXPECT_TRUE(run.model.contacts[0].reversed);  // not the table looks, which is bone
    run.advance(1.5);
    const ContactSummary contact = run.stepper.dynamics().contact_summary(0);
    EXPECT_NEAR(contact.force.norm(), weight, 1e-3 * weight);
    EXPECT_NEAR(contact.area, kSide * kSide, 0.02 * kSide * kSide);
    EXPECT_LT(contact.moment.norm(), 1e-3 * weight * kSide);
  }
}

/// Force of a ball that is pressed into the block and stays there.
/// @param stiffness_factor  of averages in time; none: by default
double force_of_a_ball(Scenario::Analysis analysis, std::optional<double> stiffness_factor) {
  Scenario s = pressed();
  s.analysis = analysis;
  s.contact_response = Scenario::Response::Averaged;
  s.contact_stiffness_factor = stiffness_factor;
  if (analysis == Scenario::Analysis::Dynamic) s.integrator.step = 10e-3;
  s.bodies[1].material->mass_damping = 20;
  s.bodies[2].geometry = SphereGeometry{0.1, 0.02, {0, 0, kSide + 0.1}};
  Simulation run(s);
  run.advance(0.1);
  if (analysis == Scenario::Analysis::Dynamic) run.advance(1.5);
  return run.stepper.dynamics().contact_summary(0).force.norm();
}

// In time it comes to rest where statics puts it, by the accurate preset. By the others the penalty
// is a tenth as stiff: here, with less than an element over the contact's radius, the force misses
// a hundredth.
TEST(ContactResponses, AveragedInTimeRestWhereStaticsDoes) {
  const double still = force_of_a_ball(Scenario::Analysis::Static, {});
  const double firm = force_of_a_ball(Scenario::Analysis::Dynamic, {});
  const double stiff = force_of_a_ball(
      Scenario::Analysis::Dynamic, preset(Scenario::Accuracy::Accurate).contact_stiffness_factor);
  EXPECT_NEAR(firm, 0.987 * still, 4e-3 * still);
  EXPECT_NEAR(stiff, still, 1e-4 * still);
}

// A ball of 20 kg/l falls 0.2 mm onto a layer, in steps of 10 ms: from a gap, iterations with stiff
// contact don't come to an end, and only those that start from soft contact do.
TEST(ContactResponses, StiffContactLandsWithoutShorterSteps) {
  Scenario s = contact_scene(10e-3);
  s.contact_stiffness_factor = preset(Scenario::Accuracy::Accurate).contact_stiffness_factor;
  s.contact_response = Scenario::Response::Averaged;
  s.integrator.element_tolerance = 5e-5;
  s.bodies = {stand("plate"),
              box_body("layer", Body::Kind::Tissue, {0.02, 0.02, 0.01}, {0, 0, 5e-3}, {10, 10, 5}),
              ball_body(20e3, {0.01, 2e-3, {0, 0, 0.0202}})};
  s.bodies[1].material = neo_hookean(20e3, 0.3);
  s.attachments = {attach("layer", "plate", {-1, -1, -1e-4}, {1, 1, 1e-4})};
  s.loads = {gravity({0, 0, -9.81})};
  Simulation run(s);
  run.advance(0.05);
  EXPECT_EQ(run.state.counts.rejected_newton, 0);
  const ContactId ball_on_layer = run.model.contacts.between(1, 2).value();
  EXPECT_GT(run.stepper.dynamics().contact_summary(ball_on_layer).force.norm(), 0.1);
}

}  // namespace articular::sim::contact_bound_test
