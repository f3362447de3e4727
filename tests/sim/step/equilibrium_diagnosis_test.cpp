// What a user is told when no equilibrium is found.
#include "sim/step/equilibrium_diagnosis.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::equilibrium_diagnosis_test {

Ligament band(const std::string& name, const Vec3& from, const Vec3& to, double stiffness) {
  Ligament ligament;
  ligament.name = name;
  ligament.path = {anchor("frame", from), anchor("plate", to)};
  ligament.stiffness = stiffness;
  return ligament;
}

/// A rigid plate on a smooth slope of tissue; a band of a thousandth of a newton a metre holds it
/// back, so that it leaves the slope long before that is in balance.
Scenario plate_on_a_slope(double stiffness) {
  Scenario s = contact_scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {
      box_body("slope", Body::Kind::Tissue, {0.06, 0.02, 0.004}, {0, 0, -0.002}, {12, 4, 1}),
      box_body("plate", Body::Kind::Rigid, {0.01, 0.01, 0.002}, {-0.02, 0, 0.001}, {2, 2, 1}),
      stand("frame")};
  s.bodies[1].density = 2000;
  s.attachments = {attach("slope", "frame", {-1, -1, -1}, {1, 1, -0.00399})};
  s.contacts = {{"slope", "plate", {}}};
  s.ligaments = {band("thread", {-0.06, 0, 0.001}, {-0.025, 0, 0.001}, stiffness)};
  s.loads = {gravity({3, 0, -9.3})};  // down the slope by a third
  return s;
}

/// A plate that can only shift along x, pulled by 1 mN against a spring of 1e-4 N/m: ten metres
/// from equilibrium. A cube of 4 mm beside it says how far a correction may go.
Scenario carriage_on_a_weak_spring() {
  Scenario s = plate_on_a_slope(1e-4);
  s.bodies[0] = box_body("slope", Body::Kind::Tissue, Vec3::Constant(0.004), {0, 0.1, -0.002});
  Hold hold;
  hold.held = {false, true, true, true, true, true};
  s.bodies[1].hold = hold;
  return s;
}

std::string message_of(const Scenario& scenario, std::int64_t& iterations) {
  Simulation run(scenario);
  std::string message;
  run.stepper.set_watch([&](double, const NewtonIteration&) {
    ++iterations;
    return false;
  });
  try {
    run.advance(1);
  } catch (const SimulationError& error) {
    message = error.what();
  }
  return message;
}

TEST(EquilibriumDiagnosis, ABodyOnAWeakSpringIsNamedWithItsMotionItsStiffnessAndWhatToAdd) {
  std::int64_t iterations = 0;
  const Scenario scenario = carriage_on_a_weak_spring();
  const std::string message = message_of(scenario, iterations);
  const std::string first = message.substr(0, message.find('\n'));
  EXPECT_NE(first.find("body `plate` is nearly free to shift along ("), std::string::npos)
      << message;
  EXPECT_NE(first.find("1.00 0.00 0.00)"), std::string::npos) << message;
  EXPECT_NE(first.find("against only 1e-07 N/mm"), std::string::npos) << message;
  EXPECT_NE(message.find("\n  to add: "), std::string::npos) << message;
  EXPECT_LE(iterations, most_load_step_iterations(step_settings(scenario)) + 200);
}

TEST(EquilibriumDiagnosis, APlateThatSlidesOffASlopeIsNamedInBoundedTime) {
  std::int64_t iterations = 0;
  const Scenario scenario = plate_on_a_slope(1e-3);
  const std::string message = message_of(scenario, iterations);
  const std::string first = message.substr(0, message.find('\n'));
  EXPECT_NE(first.find("no equilibrium was found"), std::string::npos) << message;
  EXPECT_NE(first.find("`plate`"), std::string::npos) << message;
  // What is still on its way when the limit is reached may end its solution.
  EXPECT_LE(iterations, most_load_step_iterations(step_settings(scenario)) + 200);
}

TEST(EquilibriumDiagnosis, TheSamePlateOnABandIsHeld) {
  std::int64_t iterations = 0;
  EXPECT_EQ(message_of(plate_on_a_slope(1000), iterations), "");
}

/// Iterations of which every second opens the contact and makes the band slack, every other not.
std::vector<ConvergenceRow> flipping(int count) {
  std::vector<ConvergenceRow> rows(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const bool holds = i % 2 == 0;
    rows[static_cast<std::size_t>(i)].newton.changes = {
        {SupportChange::Kind::Contact, 0, holds ? 4 : 0, holds ? 0 : 4, !holds, holds},
        {SupportChange::Kind::Ligament, 0, holds ? 1 : 0, holds ? 0 : 1, !holds, holds}};
  }
  return rows;
}

TEST(EquilibriumDiagnosis, NamesWhatOpensAndClosesAndHowOften) {
  Simulation run(plate_on_a_slope(1000));
  const std::vector<ConvergenceRow> rows = flipping(140);
  const EquilibriumDiagnosis diagnosis =
      diagnose_equilibrium(run.stepper.now(), std::nullopt, rows);
  EXPECT_NE(diagnosis.cause.find("140 iterations"), std::string::npos) << diagnosis.cause;
  EXPECT_NE(diagnosis.details.find("in the last 100 iterations"), std::string::npos);
  EXPECT_NE(diagnosis.details.find("contact of `slope` and `plate` opened or closed 100 times"),
            std::string::npos)
      << diagnosis.details;
  EXPECT_NE(diagnosis.details.find("ligament `thread` went slack or taut 100 times"),
            std::string::npos)
      << diagnosis.details;
}

// The slope is tied to the frame by its bottom; a plate of the frame's own lies under it, a quarter
// of an element below the faces beside what is tied.
TEST(EquilibriumDiagnosis, NamesTissueThatIsTiedAndPressedOntoTheSameBody) {
  const auto details_of = [](double below) {
    Scenario s = plate_on_a_slope(1000);
    s.attachments = {attach("slope", "frame", {-1, -1, -1}, {-0.019, 1, 1})};
    s.bodies[2] = box_body("frame", Body::Kind::Fixed, {0.2, 0.2, 0.01}, {0, 0, -0.009 - below});
    s.contacts.push_back({"slope", "frame", {}});
    Simulation run(s);
    return diagnose_equilibrium(run.stepper.now(), std::nullopt, {}).details;
  };
  const std::string near = details_of(0.0005), far = details_of(0.01);
  EXPECT_NE(near.find("`slope` is tied to `frame` at 30 nodes"), std::string::npos) << near;
  EXPECT_NE(near.find("`articular check --contact`"), std::string::npos) << near;
  EXPECT_EQ(far.find("is tied to"), std::string::npos) << far;
}

// A force of 1 N on a motion with 1 N/m goes a metre; with 1e6 N/m nowhere.
TEST(EquilibriumDiagnosis, CallsAMotionNearlyFreeByHowFarTheLargestForceCarriesIt) {
  Simulation run(plate_on_a_slope(1000));
  SoftMotion softest;
  softest.bodies = {{1, 1, "shift along (1.00 0.00 0.00)"}};
  const double force = run.stepper.now().largest_force;
  ASSERT_GT(force, 0);
  softest.stiffness = force / 1.0;
  EXPECT_NE(
      diagnose_equilibrium(run.stepper.now(), softest, {}).cause.find("`plate` is nearly free"),
      std::string::npos);
  const auto doubts_loads = [&] {
    const std::string details = diagnose_equilibrium(run.stepper.now(), softest, {}).details;
    EXPECT_NE(details.find("to add: "), std::string::npos) << details;
    return details.find("to look at: the loads and their units; `slope` is tied") !=
           std::string::npos;
  };
  EXPECT_FALSE(doubts_loads());  // nothing holds a plate that its spring does not
  softest.bodies = {{0, 1, "shift along (1.00 0.00 0.00)"}};
  EXPECT_TRUE(doubts_loads());
  softest.stiffness = force / 1e-6;
  EXPECT_EQ(diagnose_equilibrium(run.stepper.now(), softest, {}).cause.find("nearly free"),
            std::string::npos);
}

}  // namespace articular::sim::equilibrium_diagnosis_test
