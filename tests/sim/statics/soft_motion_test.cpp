// The softest motion of a scene, against closed forms.
#include "sim/statics/soft_motion.hpp"

#include <gtest/gtest.h>

#include "sim/build/build_model.hpp"
#include "sim/model/newton_weights.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::soft_motion_test {

constexpr double kStrong = 1000, kWeak = 2;       // [N/m]
constexpr double kLength = 0.1, kStretch = 0.01;  // [m]

Ligament spring(const std::string& name, const Vec3& from, const Vec3& to, double stiffness) {
  Ligament ligament;
  ligament.name = name;
  ligament.path = {anchor("wall", from), anchor("bone", to)};
  ligament.stiffness = stiffness;
  ligament.slack_length = (to - from).norm() - kStretch;
  return ligament;
}

/// A bone that can shift along x and z, between two strong springs along x, on a weak one along z.
Scenario bone_on_springs() {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {mass_body("bone", 0.3), stand("wall")};
  Hold hold;
  hold.held = {false, true, false, true, true, true};
  s.bodies[0].hold = hold;
  s.ligaments = {spring("left", {-kLength, 0, 0}, Vec3::Zero(), kStrong),
                 spring("right", {kLength, 0, 0}, Vec3::Zero(), kStrong),
                 spring("below", {0, 0, -kLength}, Vec3::Zero(), kWeak)};
  return s;
}

std::optional<SoftMotion> softest_of(const Scenario& scenario) {
  const Model model = build_model(scenario);
  Dynamics dynamics(model);
  Equilibrium equilibrium(model, dynamics, step_settings(scenario));
  const Eigen::VectorXd y = initial_state(model);
  dynamics.evaluate(y.data(), 0);
  return find_softest_motion(model, dynamics, equilibrium);
}

// Across, each strong spring resists with its tension by its length.
TEST(SoftMotion, OfABoneOnSpringsIsAlongTheWeakOneWithItsStiffness) {
  const auto softest = softest_of(bone_on_springs());
  ASSERT_TRUE(softest);
  const double expected = kWeak + 2 * kStrong * kStretch / kLength;
  EXPECT_NEAR(softest->stiffness, expected, 1e-6 * expected);
  EXPECT_NEAR(std::abs(softest->blocks[2]), 1, 1e-6);
  EXPECT_NEAR(softest->force, kWeak * kStretch, 1e-6 * kWeak * kStretch);
  ASSERT_EQ(softest->bodies.size(), 1U);
  EXPECT_EQ(softest->bodies[0].body, 0);
  EXPECT_NE(softest->bodies[0].words.find("shift along"), std::string::npos);
  EXPECT_NE(softest->bodies[0].words.find("1.00)"), std::string::npos) << softest->bodies[0].words;
}

// A turn about z alone: both springs act with a lever.
TEST(SoftMotion, OfABoneThatCanOnlyTurnIsThatTurn) {
  constexpr double kArm = 0.02;
  Scenario s = bone_on_springs();
  s.bodies[0].inertia = Vec3(1e-4, 1e-4, 1e-4).asDiagonal();
  s.bodies[0].hold->held = {true, true, true, true, true, false};
  s.ligaments = {spring("a", {kArm, -kLength, 0}, {kArm, 0, 0}, kWeak),
                 spring("b", {-kArm, kLength, 0}, {-kArm, 0, 0}, kWeak)};
  const auto softest = softest_of(s);
  ASSERT_TRUE(softest);
  ASSERT_EQ(softest->bodies.size(), 1U);
  EXPECT_NE(softest->bodies[0].words.find("turn about the axis"), std::string::npos);
  const double by_turn = 2 * kWeak * kArm * kArm;  // their ends move along them
  const double radius = turning_radius(build_model(s).rigid_bodies[0]);
  EXPECT_NEAR(softest->stiffness, by_turn / (radius * radius), 1e-6 * softest->stiffness);
}

// Tissue that rides on the bone is not told besides it.
TEST(SoftMotion, TellsOfTheBoneAndNotOfTheTissueOnIt) {
  Scenario s = bone_on_springs();
  s.bodies.push_back(
      box_body("pad", Body::Kind::Tissue, {0.01, 0.01, 0.01}, {0, 0, 0.05}, {2, 2, 2}));
  s.attachments = {attach("pad", "bone", {-1, -1, 0.0449}, {1, 1, 0.0451})};
  const auto softest = softest_of(s);
  ASSERT_TRUE(softest);
  ASSERT_EQ(softest->bodies.size(), 1U);
  EXPECT_EQ(softest->bodies[0].body, 0);
}

}  // namespace articular::sim::soft_motion_test
