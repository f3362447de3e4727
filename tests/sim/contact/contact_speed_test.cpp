// Bodies that are driven far too fast for the step.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "sim/base/error.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_speed_test {

constexpr double kBlock = 0.02, kElement = 0.005, kStep = 1e-3;  // [m], [m], [s]

/// A block tied to a stand under something that comes down.
Scenario driven_onto_block(const Body& driven, double speed, double way,
                           Integrator::Scheme scheme) {
  Scenario s = contact_scene(kStep, scheme);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(kBlock), Vec3::Zero(),
                       Eigen::Vector3i::Constant(4)),
              driven, stand("stand")};
  s.attachments = {attach("block", "stand", {-1, -1, -1}, {1, 1, 1e-9 - kBlock / 2})};
  s.loads = {shift(driven.name, way / speed, {0, 0, -way})};
  return s;
}

/// A driven body 2 mm above the block: a plate thinner than the block, or a ball.
Body plate() {
  return box_body("plate", Body::Kind::Fixed, {0.04, 0.04, 0.004}, {0, 0, 0.5 * kBlock + 0.004},
                  {8, 8, 1});
}
Body ball() {
  Body body;
  body.name = "ball";
  body.kind = Body::Kind::Fixed;
  body.geometry = SphereGeometry{0.008, 0.002, {0.001, 0.0005, 0.5 * kBlock + 0.010}};
  return body;
}

struct Passage {
  std::optional<std::string> stopped;  // what the SimulationError says
  double least_height = 0;  // of the block's upper side under the middle of the driven body [m]
  double lowest = 0;        // of the driven body [m]
  double most_force = 0;    // on the driven body [N]
  Counts counts;
};

/// The upper side's middle node must be below what comes down, as long as the run goes on.
Passage drive(const Body& driven, double half_height, double speed, double way,
              Integrator::Scheme scheme) {
  Simulation run(driven_onto_block(driven, speed, way, scheme));
  Passage passage;
  const int rigid = bone_of(run, driven.name);
  const double start = run.now().poses[static_cast<std::size_t>(rigid)].p.z();
  const auto* sphere = std::get_if<SphereGeometry>(&driven.geometry);
  const double center =
      sphere != nullptr ? sphere->center.z() : std::get<BoxGeometry>(driven.geometry).center.z();
  try {
    run.advance(way / speed + 5 * kStep, [&] {
      const Positions x = nodes_of(run, 0);
      const Positions& X = run.model.tissues[0].X;
      const double fallen = start - run.now().poses[static_cast<std::size_t>(rigid)].p.z();
      passage.lowest = center - half_height - fallen;
      for (Eigen::Index i = 0; i < x.cols(); ++i)
        if (X.col(i).isApprox(Vec3(0, 0, kBlock / 2), 1e-9)) passage.least_height = x(2, i);
      passage.most_force = std::max(passage.most_force, std::abs(run.force_on(rigid).z()));
    });
  } catch (const SimulationError& error) {
    passage.stopped = error.what();
  }
  passage.counts = run.state.counts;
  return passage;
}

/// The run noticed: it stopped, or the tissue pushed back.
void expect_seen(const Passage& passage) {
  if (passage.stopped) return;
  EXPECT_GT(passage.most_force, 0.01);  // [N]
}

/// The tissue gave way to what came.
void expect_held(const Passage& passage) {
  expect_seen(passage);
  if (passage.stopped) return;
  EXPECT_LT(passage.least_height, passage.lowest + 0.5 * kElement);
}

constexpr auto kEuler = Integrator::Scheme::ImplicitEuler, kBdf2 = Integrator::Scheme::TrBdf2;

// Half a block deep: slow enough to be followed.
TEST(Driven, ASlowPlateIsSeen) {
  const Passage passage = drive(plate(), 0.002, 0.2, 0.012, kEuler);
  EXPECT_FALSE(passage.stopped);
  expect_held(passage);
}

// To 6 mm in the block within six steps, and no further: there the block can give way.
TEST(Driven, ASuddenPressIsHeld) {
  for (const auto scheme : {kEuler, kBdf2}) {
    expect_held(drive(plate(), 0.002, kElement / kStep, 0.008, scheme));
    expect_held(drive(ball(), 0.008, kElement / kStep, 0.008, scheme));
  }
}

// By 3, 6 and 20 elements in a step that is not shortened, faster than waves run in the tissue: its
// elements are turned inside out sooner than it can give way, but nothing passes unnoticed.
TEST(DrivenFast, IsSeenThoughItsStepsPassSeveralElements) {
  for (const double elements : {3.0, 6.0, 20.0})
    for (const auto& [body, half_height] : {std::pair(plate(), 0.002), std::pair(ball(), 0.008)}) {
      const Passage passage = drive(body, half_height, elements * kElement / kStep, 0.03, kEuler);
      expect_seen(passage);
      EXPECT_GT(passage.counts.rejected_motion, 0);
    }
}

}  // namespace articular::sim::contact_speed_test
