// Which contacts press and which ligaments pull, and what changes.
#include "sim/statics/supports.hpp"

#include <gtest/gtest.h>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::supports_test {

/// A plate goes down by 2 mm, onto a block half a millimetre below it; a band on the plate's upper
/// side is 0.5 mm from being taut.
Scenario plate_comes_down() {
  Scenario s = contact_scene(0.25);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(0.01), {0, 0, 0.005}, {2, 2, 2}),
              box_body("plate", Body::Kind::Fixed, {0.02, 0.02, 0.002}, {0, 0, 0.0115}, {2, 2, 1}),
              stand("floor"), stand("frame")};
  s.attachments = {attach("block", "floor", {-1, -1, -1e-5}, {1, 1, 1e-5})};
  s.loads = {shift("plate", 1, {0, 0, -0.002})};
  s.contacts = {{"block", "plate", {}}};
  Ligament band;
  band.name = "band";
  band.path = {anchor("frame", {0, 0, 0.05}), anchor("plate", {0, 0, 0.0125})};
  band.stiffness = 10;
  band.slack_extension = 0.5e-3;
  s.ligaments = {band};
  return s;
}

TEST(Supports, TellWhatClosedAndWhatBecameTautAndTheReverse) {
  Simulation run(plate_comes_down());
  const Supports before(run.stepper.now());
  run.advance(1);
  const Supports after(run.stepper.now());
  const auto changes = after.changes_since(before);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].kind, SupportChange::Kind::Contact);
  EXPECT_EQ(name_of(run.model, changes[0].kind, changes[0].index),
            "contact of `block` and `plate`");
  EXPECT_EQ(changes[0].began, 9);  // the nodes of the block's upper face
  EXPECT_EQ(changes[0].ceased, 0);
  EXPECT_TRUE(changes[0].flips() && changes[0].holds);
  EXPECT_EQ(changes[1].kind, SupportChange::Kind::Ligament);
  EXPECT_EQ(name_of(run.model, changes[1].kind, changes[1].index), "ligament `band`");
  EXPECT_EQ(changes[1].began, 1);
  EXPECT_TRUE(changes[1].flips() && changes[1].holds);

  const auto back = before.changes_since(after);
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].ceased, 9);
  EXPECT_EQ(back[1].ceased, 1);
  EXPECT_FALSE(back[0].holds || back[1].holds);
  EXPECT_TRUE(after.changes_since(after).empty());
}

}  // namespace articular::sim::supports_test
