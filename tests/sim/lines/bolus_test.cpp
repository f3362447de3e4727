#include "sim/lines/bolus_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/base/error.hpp"
#include "sim/scenario/curve.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::bolus_test {

constexpr double kHeight = 0.02;

/// It rises to 100 N at 1 mm, and then breaks: 60 N at 2 mm, nothing at 3 mm.
Bolus nut() {
  Bolus bolus;
  bolus.name = "nut";
  bolus.path = {anchor("upper", Vec3::Zero()), anchor("lower", {0, 0, -kHeight})};
  bolus.force = {{0, 1e-3, 2e-3, 3e-3}, {0, 100, 60, 0}};
  bolus.unloading_stiffness = 2e5;
  return bolus;
}

BolusState pressed(double deepest, double strength = 1) { return {kHeight, deepest, 0, strength}; }

TEST(BolusLaw, TheForceIsNeverAboveTheTableAndDoesNotJump) {
  Bolus bolus = nut();
  bolus.force_kept = 0.8;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> step(-0.2e-3, 0.21e-3);
  BolusState state = pressed(0);
  double depth = 0, force = 0;
  int unloaded = 0;
  for (int i = 0; i < 2000; ++i) {
    const double next = std::clamp(depth + step(random), -1e-3, 4e-3);
    const ValueSlope now = bolus_force(bolus, state, next);
    EXPECT_GE(now.value, 0);
    EXPECT_LE(now.value,
              state.strength * value_at(bolus.force, std::max(next, state.deepest)) + 1e-9);
    EXPECT_LE(std::abs(now.value - force),
              bolus.unloading_stiffness * std::abs(next - depth) * (1 + 1e-9) + 1e-9);
    unloaded += next < state.deepest && now.value > 0 ? 1 : 0;
    EXPECT_GE(crush(bolus, next, state), 0);
    EXPECT_EQ(bolus_force(bolus, state, next).value, now.value);
    depth = next;
    force = now.value;
  }
  EXPECT_GT(unloaded, 20);
  EXPECT_GE(state.deepest, 3e-3);
  EXPECT_LT(state.strength, 0.5);
}

TEST(BolusLaw, TheSlopeIsThatOfTheForceAndTheEnergyItsIntegral) {
  const Bolus bolus = nut();
  const double h = 1e-9;
  for (const double deepest : {0.0, 0.7e-3, 1.5e-3, 2.9e-3})
    for (const double depth : {0.31e-3, 0.57e-3, 1.23e-3, 1.41e-3, 2.77e-3, 3.3e-3}) {
      const BolusState state = pressed(deepest, 0.6);
      const auto at = [&](double d) { return bolus_force(bolus, state, d).value; };
      const auto stored = [&](double d) { return bolus_energy(bolus, state, d); };
      EXPECT_NEAR(bolus_force(bolus, state, depth).slope, (at(depth + h) - at(depth - h)) / (2 * h),
                  1e-2);
      if (depth < deepest) {
        EXPECT_NEAR((stored(depth + h) - stored(depth - h)) / (2 * h), at(depth), 1e-4);
      }
    }
}

/// Steps of 0.05 mm, in which the corners of the table lie.
Scenario driven(const Bolus& bolus) {
  Scenario s = scene(5e-3);
  s.bodies = {stand("upper"), stand("lower")};
  s.boluses = {bolus};
  MotionLoad load;
  load.body = "lower";
  load.motion.time = {0, 0.15, 0.25, 0.45, 0.8};
  for (const double up : {0.0, 1.5e-3, 0.5e-3, 2.5e-3, -1e-3})
    load.motion.translation.push_back({0, 0, up});
  load.motion.interpolation = Motion::Interpolation::Linear;
  s.loads = {load};
  return s;
}

// Pressed together by 1.5 mm, let go, and pressed by 2.5 mm: the area under the table, without the
// triangle that it gives back in the end. 50 + 80 + 22.5 − 30²/400 N mm.
TEST(Bolus, WhatItTakesIsTheAreaOfTheLoop) {
  Simulation run(driven(nut()));
  double largest = 0;
  run.advance(0.8, [&] { largest = std::max(largest, -run.stepper.now().lines[0].tension); });
  EXPECT_NEAR(largest, 100, 1e-6);
  EXPECT_NEAR(run.state.boluses[0].deepest, 2.5e-3, 1e-12);
  const double area = 0.15025;  // [J]
  EXPECT_NEAR(run.state.energy.bolus_loss, area, 1e-9 * area);
  EXPECT_NEAR(run.state.energy.motion_work, area, 1e-9 * area);
  EXPECT_EQ(run.stepper.stored_energy().lines, 0);
}

// The same where half of its strength is left after the first bite: it takes 95 − 80²/400 N mm, and
// then 28.75 − 15²/400 and the 40²/400 that it stores less at the depth that it had.
TEST(Bolus, WhatIsLetGoHasLostStrength) {
  Bolus bolus = nut();
  bolus.force_kept = 0.5;
  Simulation run(driven(bolus));
  double second = 0;
  run.advance(0.8, [&] {
    if (run.state.t > 0.2) second = std::max(second, -run.stepper.now().lines[0].tension);
  });
  EXPECT_NEAR(second, 40, 1e-6);
  EXPECT_EQ(run.state.boluses[0].strength, 0.25);
  const double area = 0.0950 - 0.0160 + 0.02875 - 0.0005625 + 0.0040;  // [J]
  EXPECT_NEAR(run.state.energy.bolus_loss, area, 1e-9 * area);
  EXPECT_NEAR(run.state.energy.motion_work, area, 1e-3 * area);  // it lets go within a step
}

// A body of 1 kg at 0.5 m/s has 125 N mm. They crush the nut by 1 mm + x with 100 x − 20 x² = 75,
// where it pushes with 20 √10 N, which gives back 10 N mm.
TEST(Bolus, ABodyThatIsStoppedByItBouncesBackWithWhatItStores) {
  Scenario s = scene(1e-5, Integrator::Scheme::TrBdf2);
  s.bodies = {stand("upper"), mass_body("lower", 1, {0, 0, -kHeight})};
  s.bodies[1].velocity = {0, 0, 0.5};
  s.boluses = {nut()};
  Simulation run(s);
  run.advance(0.03);
  const double x = (100 - std::sqrt(4000.0)) / 40;  // [mm]
  EXPECT_NEAR(run.state.boluses[0].deepest, 1e-3 * (1 + x), 1e-4 * 1e-3);
  EXPECT_NEAR(run.now().velocities[0].linear.z(), -std::sqrt(0.02), 1e-3 * std::sqrt(0.02));
  EXPECT_NEAR(run.state.energy.bolus_loss, 0.115, 1e-3 * 0.115);
  EXPECT_LT(std::abs(numerical_loss(run.state, run.stepper.stored_energy())), 1e-4);
}

TEST(Bolus, WhatIsPutInLaterIsAsHighAsTheGapThen) {
  Bolus late = nut();
  late.from = 0.2;  // the gap is 1 mm less than at the start
  Simulation run(driven(late));
  run.advance(0.2);
  EXPECT_EQ(run.state.energy.motion_work, 0);
  run.advance(0.45, [&] {
    const double depth = run.state.boluses[0].height - run.stepper.now().lines[0].length;
    EXPECT_NEAR(-run.stepper.now().lines[0].tension,
                bolus_force(late, run.state.boluses[0], depth).value, 1e-9);
  });
  EXPECT_NEAR(run.state.boluses[0].height, kHeight - 1e-3, 1e-12);
  EXPECT_NEAR(run.state.boluses[0].deepest, 1.5e-3, 1e-12);
}

TEST(Bolus, WhatIsHigherThanTheGapCannotBePutIn) {
  Bolus high = nut();
  high.from = 0.15;
  high.height = kHeight;
  Simulation run(driven(high));
  EXPECT_THROW(run.advance(0.2), SimulationError);
  high.from = 0;
  high.height = 2 * kHeight;
  EXPECT_THROW(Simulation{driven(high)}, InputError);
}

}  // namespace articular::sim::bolus_test
