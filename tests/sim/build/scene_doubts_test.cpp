// What can be computed and is hardly meant.
#include "sim/build/scene_doubts.hpp"

#include <gtest/gtest.h>

#include "sim/build/build_model.hpp"
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

/// The only warning; "" without one.
std::string doubt(const Scenario& s) {
  const std::vector<std::string> warnings = build_model(s).warnings;
  EXPECT_LE(warnings.size(), 1U);
  return warnings.empty() ? "" : warnings.front();
}

testing::AssertionResult says(const std::string& doubt, const std::string& part) {
  if (doubt.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << doubt << "\" does not say " << part;
}

TEST(SceneDoubts, AreOfAGapBetweenWhatIsTied) {
  EXPECT_EQ(doubt(cartilage_on_bone(0)), "");
  EXPECT_EQ(doubt(cartilage_on_bone(4e-3)), "");
  EXPECT_TRUE(says(doubt(cartilage_on_bone(6e-3)), "across a gap of 6 mm"));
  EXPECT_EQ(doubt(cartilage_on_bone(-0.01)), "");  // well within the bone
}

TEST(SceneDoubts, AreOfTissueThatCannotDeform) {
  Scenario s = cartilage_on_bone(0);
  s.attachments = {attach("cartilage", "bone", {-1, -1, -1}, {1, 1, 1})};
  EXPECT_TRUE(says(doubt(s), "every node of `cartilage` is attached"));
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

TEST(SceneDoubts, AreOfALigamentThatStartsDrawnOut) {
  Scenario s = cartilage_on_bone(0);
  s.ligaments[0].slack_length = 0.0201;
  EXPECT_EQ(doubt(s), "");
  s.ligaments[0].slack_length = 0.015;
  EXPECT_TRUE(says(doubt(s), "drawn out by 100 %"));
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

}  // namespace articular::sim::scene_doubts_test
