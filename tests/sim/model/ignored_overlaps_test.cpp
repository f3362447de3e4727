// Bodies that lie in each other and that nothing parts.
#include "sim/model/ignored_overlaps.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sim/build/build_model.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::ignored_overlaps_test {

/// Two blocks of 10 mm, with elements of 2.5 mm, that share a layer [m] at their faces; a contact
/// of another pair.
Scenario two_blocks(double shared, Body::Kind lower = Body::Kind::Tissue,
                    Body::Kind upper = Body::Kind::Tissue) {
  Scenario s = scene(1e-3);
  s.contact = true;
  const Vec3 size = Vec3::Constant(0.01);
  s.bodies = {box_body("lower", lower, size, Vec3::Zero(), {4, 4, 4}),
              box_body("upper", upper, size, {1e-4, 2e-4, 0.01 - shared}, {4, 4, 4}),
              box_body("floor", Body::Kind::Fixed, {1, 1, 0.01}, {0, 0, -0.02})};
  s.contacts = {{"lower", "floor", {}}};
  return s;
}

std::vector<IgnoredOverlap> at_start(const Scenario& s, const ModelChange& change = {}) {
  Model model = build_model(s);
  if (change) change(model);
  return IgnoredOverlaps(s, model).at_start();
}

TEST(IgnoredOverlaps, AreAsDeepAsTheBodiesLieInEachOther) {
  const std::vector<IgnoredOverlap> found = at_start(two_blocks(3e-3));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].depth, 3e-3, 1e-12);
  EXPECT_EQ(found[0].inner + found[0].outer, 1);
  EXPECT_FALSE(found[0].is_whole);
}

TEST(IgnoredOverlaps, CountFromHalfAnElementOn) {
  EXPECT_TRUE(at_start(two_blocks(1.1e-3)).empty());
  EXPECT_EQ(at_start(two_blocks(1.4e-3)).size(), 1U);
}

TEST(IgnoredOverlaps, OfTissueAndARigidBodyCountByTheTissue) {
  EXPECT_TRUE(at_start(two_blocks(1.1e-3, Body::Kind::Rigid)).empty());
  EXPECT_TRUE(at_start(two_blocks(1.1e-3, Body::Kind::Tissue, Body::Kind::Rigid)).empty());
  EXPECT_EQ(at_start(two_blocks(1.4e-3, Body::Kind::Rigid)).size(), 1U);
}

TEST(IgnoredOverlaps, OfRigidBodiesCountFromAFiftiethOn) {
  const auto shared = [](double depth) {
    return at_start(two_blocks(depth, Body::Kind::Rigid, Body::Kind::Rigid)).size();
  };
  EXPECT_EQ(shared(0.3e-3), 0U);  // 0.35 mm of the diagonal, 17.3 mm
  EXPECT_EQ(shared(0.4e-3), 1U);
}

TEST(IgnoredOverlaps, AreNotOfBodiesThatMayTouch) {
  Scenario s = two_blocks(3e-3);
  s.contacts.push_back({"upper", "lower", {}});
  EXPECT_TRUE(at_start(s).empty());
}

TEST(IgnoredOverlaps, AreNotOfBodiesThatAreToTouchNothing) {
  Scenario s = two_blocks(3e-3);
  s.bodies[1].collides = false;
  EXPECT_TRUE(at_start(s).empty());
  s = two_blocks(3e-3);
  s.contact = false;
  EXPECT_TRUE(at_start(s).empty());
}

TEST(IgnoredOverlaps, AreNotOfTissueAndTheBoneThatItIsTiedTo) {
  Scenario s = two_blocks(3e-3, Body::Kind::Rigid);
  ASSERT_EQ(at_start(s).size(), 1U);
  s.attachments = {attach("upper", "lower", {-1, -1, -1}, {1, 1, 0.003})};
  EXPECT_TRUE(at_start(s).empty());
  s = two_blocks(3e-3, Body::Kind::Tissue, Body::Kind::Rigid);
  s.attachments = {attach("lower", "upper", {-1, -1, 0.002}, {1, 1, 1})};
  EXPECT_TRUE(at_start(s).empty());
}

TEST(IgnoredOverlaps, AreNotOfBodiesThatAreDrawnOtherwiseThanTheyTouch) {
  const Scenario s = two_blocks(3e-3, Body::Kind::Rigid, Body::Kind::Rigid);
  EXPECT_EQ(at_start(s).size(), 1U);
  EXPECT_TRUE(at_start(s, [](Model& model) { model.bodies[1].touches_as_drawn = false; }).empty());
}

TEST(IgnoredOverlaps, AreNotInOpenSurfaces) {
  const auto open = [](Model& model) {
    for (BodyModel& body : model.bodies)
      body.triangles = body.triangles.leftCols(body.triangles.cols() - 1).eval();
  };
  EXPECT_TRUE(at_start(two_blocks(3e-3, Body::Kind::Rigid, Body::Kind::Rigid), open).empty());
}

TEST(IgnoredOverlaps, AreNotOfBodiesThatAreBothHeldWhereTheyAre) {
  EXPECT_TRUE(at_start(two_blocks(3e-3, Body::Kind::Fixed, Body::Kind::Fixed)).empty());
  EXPECT_EQ(at_start(two_blocks(3e-3, Body::Kind::Fixed)).size(), 1U);
}

TEST(IgnoredOverlaps, SayWhatLiesInAnotherWhole) {
  Scenario s = two_blocks(0.01);
  std::get<BoxGeometry>(s.bodies[1].geometry).size = Vec3::Constant(0.004);
  const std::vector<IgnoredOverlap> found = at_start(s);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].is_whole);
  EXPECT_EQ(found[0].inner, 1);
}

TEST(IgnoredOverlaps, FollowTheMotion) {
  const Scenario s = two_blocks(-0.01, Body::Kind::Rigid);
  const Model model = build_model(s);
  const IgnoredOverlaps overlaps(s, model);
  Configuration now;
  const Eigen::VectorXd y = initial_state(model);
  read_state(model, y.data(), 0.7, now);
  EXPECT_TRUE(overlaps.find(now).empty());
  Pose& lower = now.poses[static_cast<std::size_t>(model.bodies[0].rigid)];
  lower.p.z() += 0.013;
  lower.R = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX());  // a cube, as before
  const std::vector<IgnoredOverlap> found = overlaps.find(now);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].depth, 3e-3, 1e-12);
  EXPECT_EQ(found[0].t, 0.7);
  const double face = found[0].inner == 1 ? 0.015 : 0.018;  // of the one in the other [m]
  EXPECT_NEAR(found[0].x.z(), face, 1e-12);
  lower.R = Eigen::AngleAxisd(M_PI / 4, Vec3::UnitX());  // now an edge is up, by 2.07 mm more
  EXPECT_GT(overlaps.find(now).at(0).depth, 3.5e-3);
  lower.R.setIdentity();
  now.x.row(2).array() += 3e-3;
  EXPECT_TRUE(overlaps.find(now).empty());
}

// A body that goes through another one is seen on its way, and not forgotten beyond.
TEST(OverlapWatch, KeepsWhatWentThrough) {
  const Scenario s = two_blocks(-0.01, Body::Kind::Rigid);
  const Model model = build_model(s);
  OverlapWatch watch(s, model);
  const Eigen::VectorXd y = initial_state(model);
  for (int i = 0; i <= 20; ++i) {
    Configuration now;
    read_state(model, y.data(), 0.1 * i, now);
    now.poses[static_cast<std::size_t>(model.bodies[0].rigid)].p.z() += 0.0022 * i;
    watch.look(now);
    EXPECT_EQ(watch.since_start().size(), i < 6 ? 0U : 1U) << i;
  }
  EXPECT_NEAR(watch.since_start()[0].t, 0.6, 1e-12);
}

TEST(OverlapWatch, IsNotOfWhatLayThereFromTheStart) {
  const Scenario s = two_blocks(3e-3);
  const Model model = build_model(s);
  OverlapWatch watch(s, model);
  Configuration now;
  const Eigen::VectorXd y = initial_state(model);
  read_state(model, y.data(), 0, now);
  watch.look(now);
  EXPECT_TRUE(watch.since_start().empty());
}

}  // namespace articular::sim::ignored_overlaps_test
