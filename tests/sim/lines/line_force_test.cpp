#include "sim/lines/line_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/lines/muscle_law.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::line_force_test {

constexpr double kLength = 0.1, kForce = 40, kActivation = 0.3;

/// A muscle of optimal length kLength from a wall to a mass.
Scenario mass_on_muscle() {
  Scenario s = scene(1e-3);
  s.bodies = {stand("wall"), mass_body("mass", 1, {0, 0, -kLength})};
  Muscle muscle;
  muscle.name = "muscle";
  muscle.path = {anchor("wall", Vec3::Zero()), anchor("mass", {0, 0, -kLength})};
  muscle.max_force = kForce;
  muscle.max_length_ratio = 1.4;
  muscle.tendon_ratio = 0.2;
  muscle.passive_fraction = 0.05;
  muscle.max_velocity = 6;
  muscle.excitation = {{0}, {kActivation}};
  s.muscles = {muscle};
  return s;
}

/// The muscle so much longer than at the start, while it gets longer at a rate.
LineState muscle_at(const Model& model, double stretch, double rate) {
  Configuration configuration;
  read_state(model, initial_state(model).data(), 0, configuration);
  const auto mass = static_cast<std::size_t>(model.bodies[1].rigid);
  configuration.poses[mass].p.z() -= stretch;
  configuration.velocities[mass].linear.z() = -rate;
  return line_state(model, model.lines[0], model.lines[0].path, configuration);
}

TEST(LineState, AMusclesTensionIsItsActiveAndItsPassiveForce) {
  const Simulation run(mass_on_muscle());
  const auto curve = Muscle::ForceLengthCurve::Cosine;
  for (const double stretch : {-0.01, 0.0, 0.005, 0.02, 0.05})
    for (const double rate : {-0.2, 0.0, 0.1}) {
      const LineState state = muscle_at(run.model, stretch, rate);
      const double length = kLength + stretch;
      EXPECT_NEAR(state.length, length, 1e-15);
      EXPECT_NEAR(state.rate, rate, 1e-15);
      const double active = kActivation * kForce *
                            active_force_length(curve, length, kLength, 0.2).value *
                            force_velocity(rate / (6 * 0.8 * kLength)).value;
      const double passive = 0.05 * kForce * passive_force_length(length, kLength, 1.4).value;
      EXPECT_NEAR(state.active, active, 1e-12 * kForce);
      EXPECT_NEAR(state.tension, active + passive, 1e-12 * kForce);
      EXPECT_NEAR(state.tension_per_activation * kActivation, active, 1e-12 * kForce);
    }
}

// At 1.3 lengths of a fibre the curves are far apart: ½(1 + cos 2.6π) and 1 − 4·0.3².
TEST(LineState, AMusclePullsByTheCurveThatItWasGiven) {
  for (const auto& [curve, factor] : {std::pair{Muscle::ForceLengthCurve::Cosine, 0.345492},
                                      std::pair{Muscle::ForceLengthCurve::Parabola, 0.64}}) {
    Scenario scenario = mass_on_muscle();
    scenario.muscles[0].force_length_curve = curve;
    const Simulation run(scenario);
    const LineState state = muscle_at(run.model, 0.3 * 0.8 * kLength, 0);
    EXPECT_NEAR(state.active, kActivation * kForce * factor, 1e-6 * kForce);
  }
}

/// A muscle whose path ends a part before its tendon does: with the path and as its whole length.
Scenario mass_on_muscle_with(const Curve& beyond, bool is_static) {
  Scenario scenario = mass_on_muscle();
  scenario.analysis = is_static ? Scenario::Analysis::Static : Scenario::Analysis::Dynamic;
  scenario.muscles[0].optimal_length = kLength;
  scenario.muscles[0].beyond = beyond;
  return scenario;
}

// By the length of the fibres it does not matter whether the path is drawn out or what lies beyond
// it, and at rest at which speed.
TEST(LineState, TendonBeyondThePathCountsInAMusclesLengthAndSpeed) {
  const double more = 0.03, rate = 0.1;
  const Simulation plain(mass_on_muscle());
  const Simulation drawn(mass_on_muscle_with({{0, 1}, {more, more + rate}}, false));
  for (const double own : {-0.2, 0.05}) {
    const LineState expected = muscle_at(plain.model, more, own + rate);
    const LineState state = muscle_at(drawn.model, 0, own);
    EXPECT_NEAR(state.length, kLength, 1e-15);
    EXPECT_EQ(state.beyond, more);
    EXPECT_NEAR(state.active, expected.active, 1e-12 * kForce);
    EXPECT_NEAR(state.tension, expected.tension, 1e-12 * kForce);
    EXPECT_NEAR(state.stored, expected.stored, 1e-12 * kForce * kLength);
    EXPECT_NEAR(state.stiffness, expected.stiffness, 1e-12 * kForce / kLength);
    EXPECT_NEAR(state.viscosity, expected.viscosity, 1e-12 * kForce / kLength);
  }
}

TEST(LineState, InStaticsWhatLiesBeyondThePathHasNoSpeed) {
  const Simulation plain(mass_on_muscle());
  const Simulation drawn(mass_on_muscle_with({{0, 1}, {0.03, 0.13}}, true));
  EXPECT_NEAR(muscle_at(drawn.model, 0, 0).tension, muscle_at(plain.model, 0.03, 0).tension,
              1e-12 * kForce);
}

TEST(LineState, AMuscleIsAtItsOptimumAtTheStartWithWhatLiesBeyondThePath) {
  Scenario scenario = mass_on_muscle_with({{0}, {0.03}}, false);
  scenario.muscles[0].optimal_length.reset();
  const Simulation run(scenario);
  EXPECT_NEAR(run.model.muscles[0].optimal_length, kLength + 0.03, 1e-15);
  EXPECT_NEAR(muscle_at(run.model, 0, 0).active, kActivation * kForce, 1e-12 * kForce);
}

TEST(LineState, AMusclesStiffnessAndViscosityAreDerivativesOfItsTension) {
  const Simulation run(mass_on_muscle());
  const double h = 1e-6;
  for (const double stretch : {-0.01, 0.03})
    for (const double rate : {-0.2, 0.1}) {
      const auto tension = [&](double more, double faster) {
        return muscle_at(run.model, stretch + more, rate + faster).tension;
      };
      const LineState state = muscle_at(run.model, stretch, rate);
      const double by_length = (tension(h, 0) - tension(-h, 0)) / (2 * h);
      const double by_rate = (tension(0, h) - tension(0, -h)) / (2 * h);
      EXPECT_NEAR(state.stiffness, std::max(0.0, by_length), 1e-6 * kForce / kLength);
      EXPECT_NEAR(state.viscosity, by_rate, 1e-6 * kForce / kLength);
    }
}

}  // namespace articular::sim::line_force_test
