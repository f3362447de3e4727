// The area above a pressure, in scenes where bodies lie in each other and nothing has moved, and
// where they press.
#include "sim/contact/pressed_area.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sim/build/build_model.hpp"
#include "sim/contact/contact_summary.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/pressed_block.hpp"
#include "tests/sim/support/probes.hpp"

namespace articular::sim::pressed_area_test {

using std::numbers::pi;

constexpr double kRadius = 0.06, kDepth = 0.004;  // of a ball, and how deep it lies in a block [m]

/// Nothing is solved.
struct BallInBlock {
  explicit BallInBlock(const Scenario& s)
      : model(build_model(s)), search(model, {}), response(model) {
    read_state(model, initial_state(model).data(), 0, now);
    search.find(now, 0.02);
    response.evaluate(now, search.candidates(), {});
  }
  double area(double threshold, int body = 0, const std::vector<char>& selected = {}) const {
    return area_above(model, response, 0, body, selected, threshold);
  }

  const Model model;
  ContactSearch search;
  ContactResponse response;
  Configuration now;
};

Scenario ball_in_block(Scenario::Response how) {
  Scenario s = contact_scene(1e-3);
  s.contact_response = how;
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.1, 0.1, 0.05}, Vec3::Zero(), {24, 24, 4}),
              ball_body(1000, {.radius = kRadius,
                               .element_size = 0.004,
                               .center = Vec3(0.0003, 0.0001, 0.025 + kRadius - kDepth)})};
  s.bodies[0].material = neo_hookean(1e5, 0.3);
  ContactPair pair;
  pair.a = "block";
  pair.b = "ball";
  s.contacts = {pair};
  return s;
}

// A pressure that goes with the depth is above a part f of its peak within s² = 2R (1 − f) D, and
// the depth of a sphere is D − s²/2R, nearly.
TEST(PressedArea, IsWhereASphereIsThatDeep) {
  for (const auto how : {Scenario::Response::Averaged, Scenario::Response::Pointwise}) {
    const BallInBlock scene(ball_in_block(how));
    const double peak =
        summary_through(scene.model, scene.response, scene.now, 0, 0, {}).max_pressure;
    for (const double part : {0.25, 0.5, 0.75}) {
      const double exact = pi * 2 * kRadius * (1 - part) * kDepth;
      EXPECT_NEAR(scene.area(part * peak), exact, 0.06 * exact) << part;
    }
    EXPECT_EQ(scene.area(1.2 * peak), 0);
  }
}

TEST(PressedArea, BecomesTheAreaThatCarries) {
  const BallInBlock scene(ball_in_block(Scenario::Response::Averaged));
  const double all = summary_through(scene.model, scene.response, scene.now, 0, 0, {}).area;
  EXPECT_GT(all, 0);
  EXPECT_NEAR(scene.area(1e-9), all, 1e-9 * all);
  EXPECT_NEAR(scene.area(1e-9, 1), all, 1e-9 * all);
}

TEST(PressedArea, OfPartsIsThatOfTheWhole) {
  const BallInBlock scene(ball_in_block(Scenario::Response::Averaged));
  const Collider& block = *scene.model.bodies[0].collider;
  std::vector<char> left, right;
  for (const auto& face : block.surface.faces.colwise()) {
    left.push_back(block.X(0, face).mean() < 0 ? 1 : 0);
    right.push_back(left.back() == 0 ? 1 : 0);
  }
  const double threshold =
      0.5 * summary_through(scene.model, scene.response, scene.now, 0, 0, {}).max_pressure;
  const double whole = scene.area(threshold);
  EXPECT_NEAR(scene.area(threshold, 0, left), whole / 2, 0.05 * whole);
  EXPECT_NEAR(scene.area(threshold, 0, left) + scene.area(threshold, 0, right), whole,
              1e-12 * whole);
}

// Even pressure between a block and a plate: all of the block, or nothing of it. Both halves
// together are the whole.
TEST(PressedArea, OfAProbeIsThatOfAPressedBlock) {
  Scenario s = pressed_block(1, shift("plate", 1, {0, 0, -2e-4}));
  s.analysis = Scenario::Analysis::Static;
  const double p = 2e-4 / (kSide / 20e3 + 1 / kStiffness);
  ContactProbe below{"block", "plate"}, above = below, low = half("block", "plate", -1);
  below.sensor.threshold = low.sensor.threshold = 0.99 * p;
  above.sensor.threshold = 1.01 * p;
  ContactsProbe both{{"low", "high"}};
  both.sensor.threshold = 0.99 * p;
  s.probes = {{"below", below},
              {"above", above},
              {"low", low},
              {"high", half("block", "plate", 1)},
              {"both", both}};
  Simulation run(s, contact_stiffness_of(kStiffness));
  EXPECT_EQ(Probes(run)("below.area_above_threshold [mm^2]"), 0);
  run.advance(1);
  const Probes probes(run);
  const double all = 1e6 * kSide * kSide;
  EXPECT_NEAR(probes("below.area_above_threshold [mm^2]"), all, 1e-5 * all);
  EXPECT_EQ(probes("above.area_above_threshold [mm^2]"), 0);
  EXPECT_NEAR(probes("low.area_above_threshold [mm^2]"), all / 2, 1e-5 * all);
  EXPECT_NEAR(probes("both.area_above_threshold [mm^2]"), all, 1e-5 * all);
}

}  // namespace articular::sim::pressed_area_test
