// Nodes that a region near a bone ties apart from the patch that was meant.
#include "sim/build/tie_doubts.hpp"

#include <gtest/gtest.h>

#include "tests/sim/support/doubt.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::tie_doubts_test {

constexpr double kNear = 1e-3;

/// A saddle of tissue above a plate: one corner lies on it, and ten nodes around it within kNear.
/// Of the opposite corner only the node itself may: it lies at `height` [m].
Scenario saddle_on_plate(double height) {
  Scenario s = scene(1e-3);
  s.contact = false;
  constexpr double kSide = 12e-3, kThick = 2e-3, kHigh = 3.4e-3;
  Body tissue = box_body("tissue", Body::Kind::Tissue, {kSide, kSide, kThick});
  HexahedronGeometry saddle;
  saddle.corners.row(0) << 0, kSide, kSide, 0, 0, kSide, kSide, 0;
  saddle.corners.row(1) << 0, 0, kSide, kSide, 0, 0, kSide, kSide;
  saddle.corners.row(2) << 0, kHigh, height, kHigh, kThick, kHigh + kThick, height + kThick,
      kHigh + kThick;
  saddle.cells = {12, 12, 1};
  tissue.geometry = saddle;
  s.bodies = {box_body("plate", Body::Kind::Fixed, {0.1, 0.1, 0.01}, {0, 0, -0.005}), tissue};
  Attachment tie;
  tie.body = "tissue";
  tie.to = "plate";
  tie.region.near_body = {"plate", kNear};
  s.attachments = {tie};
  return s;
}

TEST(TieDoubts, AreOfANodeApartFromThePatch) {
  EXPECT_EQ(doubt(saddle_on_plate(1.05e-3)), "");
  EXPECT_TRUE(says(doubt(saddle_on_plate(0.95e-3)),
                   "`near` ties a node of `tissue` to `plate` apart from a patch of 11, at (12.000 "
                   "12.000 0.950) mm"));
}

TEST(TieDoubts, AreNotOfTwoPatches) { EXPECT_EQ(doubt(saddle_on_plate(0)), ""); }

TEST(TieDoubts, AreNotOfANodeThatIsNamedByItsPlace) {
  Scenario s = saddle_on_plate(1.05e-3);
  s.attachments.push_back(attach("tissue", "plate", {0.0119, 0.0119, 0}, {0.0121, 0.0121, 0.0015}));
  EXPECT_EQ(doubt(s), "");
}

}  // namespace articular::sim::tie_doubts_test
