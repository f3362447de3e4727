// Rigid bodies with a layer between them that stiffens as it is pressed flat.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/build/build_model.hpp"
#include "sim/contact/contact_summary.hpp"
#include "sim/model/tissue.hpp"
#include "sim/output/run_warnings.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::stiffening_layer_test {

constexpr double kSide = 0.01;  // [m]: 1 cm², as the crown of a molar
// Of the periodontal ligaments of both rows.
constexpr Layer kLigaments{0.4e-3, 1.2e6, 0.45, Layer::Law::Logarithmic};

double modulus(const Layer& layer) {
  return constrained_modulus(layer.young_modulus, layer.poisson_ratio);
}

/// A block above a floor that is wider, with the layer on the floor. The block has no less than
/// three nodes along an edge.
/// @param down  how deep it lies in the layer [m]
Scenario block_on_floor(double down, const Layer& layer, Integrator::Scheme scheme, double step) {
  Scenario s = contact_scene(step, scheme);
  s.bodies = {box_body("floor", Body::Kind::Fixed, {2 * kSide, 2 * kSide, kSide},
                       {0, 0, -0.5 * kSide}, {3, 3, 1}),
              box_body("block", Body::Kind::Rigid, Vec3::Constant(kSide),
                       {0, 0, 0.5 * kSide - down}, {4, 4, 1})};
  s.bodies[0].layer = layer;
  return s;
}

Scenario at_rest(double down, const Layer& layer) {
  return block_on_floor(down, layer, Integrator::Scheme::ImplicitEuler, 1e-3);
}

ContactSummary contact_of(const Scenario& s) {
  return Simulation(s).stepper.dynamics().contact_summary(0);
}

// Flat on each other all depths are alike, so that means have the law's own pressure and energy:
// in statics and in time. Bones beside the layer give way by 1e-4 of it, and where it is stiff they
// have ten times that of what it gives way.
TEST(StiffeningLayer, BetweenFlatFacesHasTheForceAndTheEnergyOfItsLaw) {
  const double M = modulus(kLigaments), t = kLigaments.thickness;
  for (const auto analysis : {Scenario::Analysis::Static, Scenario::Analysis::Dynamic})
    for (const double u : {0.1, 0.5, 0.85}) {
      Scenario s = at_rest(u * t, kLigaments);
      s.analysis = analysis;
      const ContactSummary sum = contact_of(s);
      const double area = kSide * kSide;
      EXPECT_NEAR(sum.force.norm() / (-M * std::log(1 - u) * area), 1, 2e-3) << u;
      EXPECT_NEAR(sum.energy / (M * t * ((1 - u) * std::log(1 - u) + u) * area), 1, 2e-3) << u;
    }
}

TEST(StiffeningLayer, HasAveragedDepthsInTimeWhateverIsAskedFor) {
  Scenario s = at_rest(0.1e-3, kLigaments);
  s.contact_response = Scenario::Response::Pointwise;
  EXPECT_TRUE(build_model(s).contacts[0].averaged);
  s.bodies[0].layer->law = Layer::Law::Linear;
  EXPECT_FALSE(build_model(s).contacts[0].averaged);
}

/// How far a force presses a block into a layer [m], in equilibrium.
double depth_under(double force, const Layer& layer) {
  Scenario s = at_rest(0, layer);
  s.analysis = Scenario::Analysis::Static;
  s.bodies[1].hold.emplace().held = {true, true, false, true, true, true};
  s.loads = {ForceLoad{anchor("block", {0, 0, kSide}), {0, 0, -force}, {}, {}}};
  Simulation run(s);
  run.advance(1);
  EXPECT_TRUE(run_warnings(run.model, run.state, run.stepper).empty()) << force;
  return run.stepper.dynamics().contact_summary(0).max_depth;
}

// p = −M ln(1 − d/t). 100 N press the tooth of one row in by 0.04 mm, half of what both have. The
// linear law would press 800 N through 0.7 mm of 0.4, and run would warn.
TEST(StiffeningLayer, IsNotPressedThroughByAHardBite) {
  const double M = modulus(kLigaments), t = kLigaments.thickness, area = kSide * kSide;
  for (const double force : {1.0, 100.0, 800.0})
    EXPECT_NEAR(depth_under(force, kLigaments) / (t * (1 - std::exp(-force / (M * area)))), 1, 1e-3)
        << force;
  EXPECT_NEAR(0.5 * depth_under(100, kLigaments), 0.0395e-3, 0.0001e-3);
}

/// What a block that falls onto the floor and bounces twice has lost of its energy by the time
/// integration, of what its fall had; and how deep it went.
struct Bounce {
  double loss = 0, deepest = 0;  // [J], [m]
};
Bounce bounce(const Vec3& spin, double step) {
  constexpr double kHeight = 2e-3;  // [m]
  Layer soft = kLigaments;
  soft.young_modulus = 300;  // half of it is pressed flat
  Scenario s = block_on_floor(-kHeight, soft, Integrator::Scheme::TrBdf2, step);
  s.loads = {gravity({0, 0, -9.81})};
  s.bodies[1].angular_velocity = spin;
  Simulation run(s);
  Bounce result;
  run.advance(0.09, [&] {
    result.deepest = std::max(result.deepest, run.stepper.dynamics().contact_summary(0).max_depth);
  });
  result.loss = run.loss() / (1000 * std::pow(kSide, 3) * 9.81 * kHeight);
  return result;
}

// Forces have an energy: what is lost goes with the step, by the order of the scheme, also where
// the block comes in with an edge first.
TEST(StiffeningLayer, KeepsTheEnergyOfABlockThatBounces) {
  for (const Vec3& spin : {Vec3(0, 0, 0), Vec3(2, 3, 1)}) {
    const Bounce coarse = bounce(spin, 0.2e-3), fine = bounce(spin, 0.1e-3);
    EXPECT_GT(fine.deepest, 0.3 * kLigaments.thickness);
    EXPECT_LT(std::abs(fine.loss), 0.01);
    EXPECT_LT(std::abs(fine.loss), 0.4 * std::abs(coarse.loss));
  }
}

}  // namespace articular::sim::stiffening_layer_test
