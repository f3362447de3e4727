// What can be computed and is hardly meant.
#include "sim/build/scene_doubts.hpp"

#include <gtest/gtest.h>

#include "tests/sim/support/doubt.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::scene_doubts_test {

/// Cartilage of 5 mm elements that is tied to a bone across a gap [m], and a ligament.
Scenario cartilage_on_bone(double gap) {
  Scenario s = scene(1e-3);
  s.contact = false;
  Body bone = box_body("bone", Body::Kind::Rigid, {0.05, 0.05, 0.02}, {0, 0, -0.01});
  bone.density = 1800;
  s.bodies = {
      bone,
      box_body("cartilage", Body::Kind::Tissue, {0.02, 0.02, 0.02}, {0, 0, 0.01 + gap}, {4, 4, 4}),
      stand("floor")};
  s.attachments = {attach("cartilage", "bone", {-1, -1, gap - 1e-6}, {1, 1, gap + 1e-6})};
  Ligament ligament;
  ligament.name = "acl";
  ligament.path = {anchor("bone", {0, 0, 0}), anchor("floor", {0, 0, 0.03})};
  ligament.law = Ligament::Law::Linear;
  ligament.stiffness = 100;
  ligament.slack_length = 0.025;
  s.ligaments = {ligament};
  return s;
}

TEST(SceneDoubts, AreOfAGapBetweenWhatIsTied) {
  EXPECT_EQ(doubt(cartilage_on_bone(0)), "");
  EXPECT_EQ(doubt(cartilage_on_bone(4e-3)), "");
  EXPECT_TRUE(says(doubt(cartilage_on_bone(6e-3)), "across a gap of 6 mm"));
  EXPECT_EQ(doubt(cartilage_on_bone(-0.01)), "");  // well within the bone
}

TEST(SceneDoubts, AreOfContactAsSoftAsWhatTouches) {
  Scenario s = cartilage_on_bone(0);
  s.contact_stiffness_factor = 10;
  EXPECT_EQ(doubt(s), "");
  s.contact_stiffness_factor = 0.1;
  EXPECT_TRUE(says(doubt(s), "sink into each other farther than the elements"));
}

TEST(SceneDoubts, AreOfTissueThatCannotDeform) {
  Scenario s = cartilage_on_bone(0);
  s.attachments = {attach("cartilage", "bone", {-1, -1, -1}, {1, 1, 1})};
  EXPECT_TRUE(says(doubt(s), "every node of `cartilage` is attached"));
}

TEST(SceneDoubts, AreOfTheReactionOfABodyThatNothingLoads) {
  Scenario s = cartilage_on_bone(0);
  s.bodies[2] = box_body("floor", Body::Kind::Fixed, {0.05, 0.05, 0.01}, {0, 0, 0.05});
  s.bodies.push_back(stand("wall"));
  s.ligaments[0].path[1].point = {0, 0, 0.045};
  s.ligaments[0].slack_length = 0.045;
  s.probes = {{"floor", ReactionProbe{"floor"}}};
  EXPECT_EQ(doubt(s), "");  // the ligament ends on it
  s.ligaments[0].path[1].body = "wall";
  EXPECT_TRUE(says(doubt(s), "the reaction of `floor` is always 0"));
  s.ligaments[0].wrap = {"floor"};
  EXPECT_FALSE(says(doubt(s), "always 0"));
  s.ligaments.clear();
  s.attachments.push_back(attach("cartilage", "floor", {-1, -1, 0.02}, {1, 1, 1}));
  EXPECT_FALSE(says(doubt(s), "always 0"));
  s.attachments.pop_back();
  s.contact = true;
  s.contacts = {{"floor", "bone", {}}};
  EXPECT_FALSE(says(doubt(s), "always 0"));
  s.contacts = {{"cartilage", "bone", {}}};
  EXPECT_TRUE(says(doubt(s), "the reaction of `floor` is always 0"));
}

TEST(SceneDoubts, AreOfLoadsOnNothingButWhatIsTied) {
  const auto between = [](double low, double high) {
    TissueRegion at{"cartilage", {}};
    at.region.box = {Vec3(-1, -1, low), Vec3(1, 1, high)};
    return at;
  };
  const auto force = [](const TissueRegion& at) {
    ForceLoad load;
    load.at = at;
    return load;
  };
  const auto pressure = [](const TissueRegion& at) {
    SurfaceLoad load;
    load.at = at;
    load.stress = 1e3;
    return load;
  };
  const TissueRegion tied = between(-1e-6, 1e-6), both = between(-1e-6, 6e-3),
                     free = between(0.019, 0.021);
  Scenario s = cartilage_on_bone(0);
  s.loads = {force(both), force(free), pressure(both), pressure(free)};
  EXPECT_EQ(doubt(s), "");
  s.loads = {pressure(free), force(free), force(tied)};
  EXPECT_TRUE(says(doubt(s), "every loaded node of `cartilage` (25 in the region) is attached"));
  s.loads = {force(free), pressure(free), pressure(tied)};
  EXPECT_TRUE(says(doubt(s), "every loaded face of `cartilage` (32 in the region) is attached"));
}

TEST(SceneDoubts, AreOfAForceThatASupportTakes) {
  Scenario s = cartilage_on_bone(0);
  Support roller;
  roller.body = "cartilage";
  roller.region.box = {Vec3(-1, -1, 0.019), Vec3(1, 1, 0.021)};
  roller.held = Vec3::UnitZ();
  s.supports = {roller};
  ForceLoad load;
  load.at = TissueRegion{"cartilage", roller.region};
  for (const Vec3& force : {Vec3(0, 0, -1), Vec3(1, 0, -1), Vec3(0, 1, 0)}) {
    load.force = force;
    s.loads = {load};
    const bool is_taken = force.x() == 0 && force.y() == 0;
    EXPECT_EQ(doubt(s).find("every loaded node of `cartilage` (25 in the region) is held along") !=
                  std::string::npos,
              is_taken)
        << force.transpose();
  }
  load.force = {0, 0, -1};
  std::get<TissueRegion>(load.at).region.box->first.z() = 0.014;  // a row that is free
  s.loads = {load};
  EXPECT_EQ(doubt(s), "");
}

TEST(SceneDoubts, AreOfContactOfTwoFixedBodies) {
  Scenario s = cartilage_on_bone(0);
  s.attachments.clear();
  s.contact = true;
  s.bodies[2] = box_body("floor", Body::Kind::Fixed, {0.1, 0.1, 0.01}, {0, 0, -0.1});
  s.bodies.push_back(box_body("wall", Body::Kind::Fixed, {0.1, 0.1, 0.01}, {0, 0, -0.2}));
  s.ligaments.clear();
  ContactPair pair;
  pair.a = "cartilage";
  pair.b = "floor";
  s.contacts = {pair};
  EXPECT_EQ(doubt(s), "");
  s.contacts[0].a = "wall";
  EXPECT_TRUE(says(doubt(s), "`wall` and `floor` are both fixed: nothing gives way"));
}

TEST(SceneDoubts, AreOfASheetOnNothingButWhatIsTied) {
  Scenario s = cartilage_on_bone(0);
  const auto sheet = [](double low, double high) {
    Sheet made;
    made.name = "fascia";
    made.at.tissue = "cartilage";
    made.at.region.box = {Vec3(-1, -1, low), Vec3(1, 1, high)};
    made.thickness = 1e-3;
    made.young_modulus = 1e7;
    made.fibres = Fibres{Vec3(1, 0, 1).normalized()};
    return made;
  };
  s.sheets = {sheet(0.019, 0.021)};
  EXPECT_EQ(doubt(s), "");
  s.sheets = {sheet(-1e-6, 0.021)};  // sides too
  EXPECT_EQ(doubt(s), "");
  s.sheets = {sheet(-1e-6, 1e-6)};
  EXPECT_TRUE(says(doubt(s), "every face of sheet `fascia` is attached to a body"));
}

TEST(SceneDoubts, AreOfALigamentThatStartsDrawnOut) {
  Scenario s = cartilage_on_bone(0);
  s.ligaments[0].slack_length = 0.03 / 1.39;
  EXPECT_EQ(doubt(s), "");
  s.ligaments[0].slack_length = 0.03 / 1.41;
  EXPECT_TRUE(says(doubt(s), "drawn out by 41 %"));
}

TEST(SceneDoubts, AreOfALigamentThatHardlyEverGetsTaut) {
  Scenario s = cartilage_on_bone(0);
  s.ligaments[0].slack_length = 1.9 * 0.03;
  EXPECT_EQ(doubt(s), "");
  s.ligaments[0].slack_length = 9.5 * 0.03;
  EXPECT_TRUE(says(doubt(s), "is slack until it is 9.5 times as long"));
}

TEST(SceneDoubts, AreOfJointAxesThatPointOppositeWays) {
  JointProbe joint;
  joint.proximal = {"floor", Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ()};
  joint.distal = {"bone", Vec3::Zero(), Vec3(0.9, 0.1, 0).normalized(), Vec3::UnitZ()};
  Scenario s = cartilage_on_bone(0);
  s.probes = {{"knee", joint}};
  EXPECT_EQ(doubt(s), "");
  joint.distal.lateral *= -1;
  s.probes = {{"knee", joint}};
  EXPECT_TRUE(says(doubt(s), "`lateral` of `floor` and of `bone` point opposite ways"));
}

// The lateral axis of a right joint points to the right, that of a left one to the left.
TEST(SceneDoubts, AreOfJointAxesThatPointInwards) {
  const auto of = [](const std::string& towards_x, bool is_right, double x, double y) {
    JointProbe joint;
    const Vec3 lateral = Vec3(x, y, 0).normalized();
    joint.proximal = {"floor", Vec3::Zero(), lateral, Vec3::UnitZ()};
    joint.distal = {"bone", Vec3::Zero(), lateral, Vec3::UnitZ()};
    joint.is_right = is_right;
    Scenario s = cartilage_on_bone(0);
    s.output.directions = {towards_x, "posterior", "superior"};
    s.probes = {{"knee", joint}};
    return doubt(s);
  };
  EXPECT_EQ(of("left", false, 1, 0.1), "");
  EXPECT_EQ(of("left", true, -1, 0.1), "");
  EXPECT_EQ(of("right", true, 1, 0), "");
  EXPECT_EQ(of("medial", true, -1, 0), "");
  EXPECT_EQ(of("lateral", false, 1, 0), "");
  EXPECT_EQ(of("left", true, 0.1, 1), "");  // along another axis: no word for it
  EXPECT_TRUE(says(of("left", false, -1, 0.1), "`lateral` of `floor` points inwards"));
  EXPECT_TRUE(says(of("right", false, 1, 0), "\"right\" for +x and the joint `knee` is a left"));
  EXPECT_TRUE(says(of("medial", true, 1, 0), "\"medial\" for +x"));
  EXPECT_TRUE(says(of("lateral", false, -1, 0), "\"lateral\" for +x"));
}

TEST(SceneDoubts, AreOfADrivenBodyThatJumpsAtTheStart) {
  const auto of = [](const Vec3& translation, const Vec3& rotation) {
    MotionLoad load = shift("floor", 1, {0, 0, 0.01});
    load.motion.translation.front() = translation;
    load.motion.rotation = {rotation, Vec3::Zero()};
    Scenario s = cartilage_on_bone(0);
    s.ligaments.clear();
    s.loads = {load};
    return doubt(s);
  };
  EXPECT_EQ(of(Vec3::Zero(), Vec3::Zero()), "");
  EXPECT_EQ(of({5e-6, 0, 0}, {0, 5e-5, 0}), "");
  EXPECT_TRUE(says(of({0, 3e-3, 4e-3}, Vec3::Zero()), "jumps by 5 mm and 0 degrees"));
  EXPECT_TRUE(says(of(Vec3::Zero(), {0, 0, 0.1}), "jumps by 0 mm and 5.73 degrees"));
}

/// A block of tissue that lies by 3 mm in another, which stands on the floor.
Scenario one_block_in_another() {
  Scenario s = scene(1e-3);
  s.contact = true;
  const Vec3 size = Vec3::Constant(0.01);
  s.bodies = {box_body("floor", Body::Kind::Fixed, {0.05, 0.05, 0.01}, {0, 0, -0.01}),
              box_body("lower", Body::Kind::Tissue, size, Vec3::Zero(), {4, 4, 4}),
              box_body("upper", Body::Kind::Tissue, size, {0, 0, 0.007}, {4, 4, 4})};
  s.contacts = {{"lower", "floor", {}}};
  return s;
}

TEST(SceneDoubts, AreOfABodyThatLiesInAnotherAndWasForgottenByContact) {
  Scenario s = one_block_in_another();
  EXPECT_TRUE(says(doubt(s), "to 3 mm at "));
  EXPECT_TRUE(says(doubt(s), "no [[contact]] names `upper`"));
  s.contacts.push_back({"upper", "floor", {}});  // then it is meant
  EXPECT_EQ(doubt(s), "");
  s = one_block_in_another();
  s.contacts.clear();  // all touch
  EXPECT_EQ(doubt(s), "");
}

TEST(SceneDoubts, AreNotOfABodyThatLiesInAnotherWhole) {
  Scenario s = one_block_in_another();
  s.bodies[2] = box_body("tumour", Body::Kind::Tissue, Vec3::Constant(0.005), {0, 0, 0}, {2, 2, 2});
  EXPECT_EQ(doubt(s), "");
}

}  // namespace articular::sim::scene_doubts_test
