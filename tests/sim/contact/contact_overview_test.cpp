// What is told of contact before a run.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/build/build_model.hpp"
#include "sim/contact/contact_overview.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_overview_test {

constexpr double kGap = 7e-4;  // [m]

/// A block on a floor that it is tied to, below a plate.
Scenario block_between() {
  Scenario s = contact_scene(1e-3);
  s.bodies = {
      box_body("block", Body::Kind::Tissue, {0.02, 0.02, 0.02}, {0, 0, 0.01}, {4, 4, 4}),
      box_body("floor", Body::Kind::Fixed, {0.05, 0.05, 0.004}, {0, 0, -0.002}, {5, 5, 1}),
      box_body("plate", Body::Kind::Rigid, {0.01, 0.01, 0.002}, {0, 0, 0.021 + kGap}, {2, 2, 1})};
  s.attachments = {attach("block", "floor", {-1, -1, -1}, {1, 1, 1e-6})};
  s.contacts = {{"block", "plate", {}}, {"block", "floor", {}}, {"block", "block", {}}};
  return s;
}

TEST(ContactOverview, DistancesAreThoseOfTheNearestNodeThatIsNotTied) {
  const auto pairs = contact_overviews(build_model(block_between()));
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_NEAR(pairs[0].distance, kGap, 1e-12);
  EXPECT_NEAR(pairs[0].place.z(), 0.02, kGap + 1e-12);
  EXPECT_EQ(pairs[0].num_tied_nodes, 0);
  // Faces of the sides that have a tied node are left out: the next nodes are a cell above.
  EXPECT_NEAR(pairs[1].distance, 0.005, 1e-12);
  EXPECT_TRUE(std::isinf(pairs[2].distance));
}

// 25 nodes and 32 faces below; beside them, of each side, the lower row's 8 faces.
TEST(ContactOverview, CountsWhatIsTiedAndMayTouchAllTheSame) {
  const auto pairs = contact_overviews(build_model(block_between()));
  EXPECT_EQ(pairs[1].num_tied_nodes, 25);
  EXPECT_EQ(pairs[1].num_tied_faces, 32 + 4 * 8);
  EXPECT_EQ(pairs[1].num_free_faces, 6 * 32 - (32 + 4 * 8));
  EXPECT_EQ(pairs[1].num_close_faces, 0);
  Scenario s = block_between();
  s.attachments = {attach("block", "floor", {-1, -1, -1}, {1e-6, 1, 1e-6})};
  const ContactOverview half = contact_overviews(build_model(s))[1];
  EXPECT_EQ(half.num_tied_nodes, 15);
  EXPECT_EQ(half.num_close_faces, 8);  // they lie on the floor: both tied to it and in contact
}

TEST(ContactOverview, BodiesThatNeitherMoveCannotMeet) {
  Scenario s = block_between();
  s.bodies[2].kind = Body::Kind::Fixed;
  s.contacts = {{"plate", "floor", {}}, {"plate", "block", {}}};
  auto pairs = contact_overviews(build_model(s));
  EXPECT_FALSE(pairs[0].can_move);
  EXPECT_TRUE(pairs[1].can_move);
  s.loads = {shift("plate", 1, {0, 0, 1e-3})};
  EXPECT_TRUE(contact_overviews(build_model(s))[0].can_move);
}

// Cells of 10 mm with a long edge of 14.1 mm: those 1 mm high are flat under the faces above and
// below.
TEST(SurfaceOverview, FlatElementsAreThoseBelowAFifthOfAnEdge) {
  for (const auto& [height, flat] : {std::pair(0.003, 0), std::pair(0.001, 16)}) {
    Scenario s = block_between();
    s.bodies[0].geometry = BoxGeometry{{0.02, 0.02, 3 * height}, {2, 2, 3}, {0, 0, 0.5}};
    s.attachments.clear();
    const SurfaceOverview block = surface_overviews(build_model(s))[0];
    EXPECT_EQ(block.num_faces, 16 + 4 * 12);
    EXPECT_EQ(block.num_flat, flat);
    if (flat == 0) continue;
    EXPECT_NEAR(std::abs(block.flattest.z() - 0.5), 1.5 * height, 1e-12);
  }
}

}  // namespace articular::sim::contact_overview_test
