// An elastic layer between rigid bodies in statics: springs side by side, p = M d/t at each point.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "sim/build/build_model.hpp"
#include "sim/model/tissue.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::elastic_layer_test {

const Layer kLayer{2e-3, 5e6, 0.45};
constexpr double kForce = 100;  // [N]

double stiffness() {  // [Pa/m]
  return constrained_modulus(kLayer.young_modulus, kLayer.poisson_ratio) / kLayer.thickness;
}

/// A body that may only go up and down, pressed onto a plate with a layer.
Scenario pressed(Body body, const Eigen::Vector3i& cells) {
  Scenario s = contact_scene(1);
  s.analysis = Scenario::Analysis::Static;
  body.hold.emplace().held = {true, true, false, true, true, true};
  s.bodies = {box_body("plate", Body::Kind::Fixed, {0.04, 0.04, 0.01}, {0, 0, -0.005}, cells),
              body};
  s.bodies[0].layer = kLayer;
  s.loads = {ForceLoad{anchor(body.name, {0, 0, 0.01}), {0, 0, -kForce}, {}, {}}};
  return s;
}

/// How deep the lowest point of the body lies, which began at z = 0 [m].
double way_down(const Simulation& run) {
  return run.model.rigid_bodies[0].rest.p.z() - run.now().poses[0].p.z();
}

// Whatever the faces of both are, and however few lie across: no node counts for a part of itself.
// Beside the layer the bones give way, by up to 2e-4 of it.
TEST(ElasticLayer, SinksUnderAFlatPunchByItsPressure) {
  constexpr double kSide = 0.02;
  const double pressure = kForce / (kSide * kSide);
  for (const int of_plate : {1, 7, 16})
    for (const int of_punch : {1, 3, 16}) {
      Simulation run(pressed(box_body("punch", Body::Kind::Rigid, {kSide, kSide, 0.01},
                                      {0, 0, 0.005}, {of_punch, of_punch, 1}),
                             {of_plate, of_plate, 1}));
      run.advance(1);
      const ContactSummary sum = run.stepper.dynamics().contact_summary(0);
      EXPECT_NEAR(way_down(run), pressure / stiffness(), 3e-4 * pressure / stiffness())
          << of_plate << " " << of_punch;
      EXPECT_NEAR(sum.area, kSide * kSide, 1e-6 * kSide * kSide);
      EXPECT_NEAR(sum.max_pressure, pressure, 3e-4 * pressure);
    }
}

TEST(ElasticLayer, MayLieOnEitherBodyOrOnBoth) {
  const Layer half{kLayer.thickness / 2, kLayer.young_modulus, kLayer.poisson_ratio};
  using Layers = std::pair<std::optional<Layer>, std::optional<Layer>>;
  for (const Layers& layers :
       {Layers{kLayer, std::nullopt}, Layers{std::nullopt, kLayer}, Layers{half, half}}) {
    Scenario s = pressed(
        box_body("punch", Body::Kind::Rigid, Vec3::Constant(0.01), {0, 0, 0.005}, {3, 3, 3}),
        {7, 7, 1});
    std::tie(s.bodies[0].layer, s.bodies[1].layer) = layers;
    Simulation run(s);
    run.advance(1);
    const double way = kForce / (1e-4 * stiffness());
    EXPECT_NEAR(way_down(run), way, 3e-4 * way)
        << layers.first.has_value() << layers.second.has_value();
  }
}

// Tissue has facets that averages let give way, whatever it lies on.
TEST(ElasticLayer, IsCountedPointByPointBetweenRigidBodiesOnly) {
  for (const Body::Kind kind : {Body::Kind::Rigid, Body::Kind::Tissue})
    for (const bool has_layer : {true, false}) {
      Scenario s = contact_scene(1);
      s.analysis = Scenario::Analysis::Static;
      s.bodies = {box_body("plate", Body::Kind::Fixed, {0.04, 0.04, 0.01}, {0, 0, -0.005}),
                  box_body("block", kind, Vec3::Constant(0.01), {0, 0, 0.006}, {3, 3, 3})};
      if (has_layer) s.bodies[0].layer = kLayer;
      EXPECT_EQ(build_model(s).contacts[0].averaged, kind == Body::Kind::Tissue || !has_layer);
    }
}

// F = π k R δ², by the integral of k (δ − r²/2R).
TEST(ElasticLayer, SinksUnderABallByTheRootOfTheForce) {
  constexpr double kRadius = 0.02;
  Simulation run(pressed(ball_body(1000, {kRadius, 1e-3, {0, 0, kRadius}}), {9, 9, 1}));
  run.advance(1);
  const double way = std::sqrt(kForce / (std::numbers::pi * stiffness() * kRadius));
  EXPECT_NEAR(way_down(run), way, 0.02 * way);
  const ContactSummary sum = run.stepper.dynamics().contact_summary(0);
  EXPECT_NEAR(sum.max_pressure, stiffness() * way, 0.04 * stiffness() * way);
}

}  // namespace articular::sim::elastic_layer_test
