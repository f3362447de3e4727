// Clench and bite of scenarios/mandible/ beside the rule of levers.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "sim/scenario/muscle_table.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::bite_test {

using sim::Vec3;

constexpr double kLevel = 0.3;  // of all closers' excitation

/// Force [N] and moment about the origin [N m].
struct Wrench {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  Vec3 moment_about(const Vec3& p) const { return moment - p.cross(force); }
};

void add(const Vec3& force, const Vec3& at, Wrench& sum) {
  sum.force += force;
  sum.moment += at.cross(force);
}

Vec3 at_row(const ScenarioResults& results, const std::string& point, bool last) {
  const auto along = [&](const char* axis) {
    const auto& column = results.column(point + ".position." + axis + " [mm]");
    return 1e-3 * (last ? column.back() : column.front());
  };
  return {along("x"), along("y"), along("z")};
}

/// Of three points of the jaw: their middle, and axes by them.
Eigen::Isometry3d jaw_frame(const ScenarioResults& results, bool last) {
  const Vec3 incisor = at_row(results, "incisor", last),
             left = at_row(results, "condyle_left", last),
             right = at_row(results, "condyle_right", last);
  Eigen::Matrix3d axes;
  axes.col(0) = (left - right).normalized();
  axes.col(2) = axes.col(0).cross(0.5 * (left + right) - incisor).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() = axes;
  frame.translation() = (left + right + incisor) / 3;
  return frame;
}

/// What the closers of the table put on the mandible, where it has come to rest.
Wrench closers(const ScenarioResults& results) {
  const Eigen::Isometry3d moved = jaw_frame(results, true) * jaw_frame(results, false).inverse();
  Wrench sum;
  for (const sim::MuscleRow& row : sim::read_muscle_table(
           std::filesystem::path(ARTICULAR_SOURCE_DIR) / "scenarios/mandible/anatomy/muscles.csv",
           {})) {
    const bool closes = row.muscle.find("temporalis") != std::string::npos ||
                        row.muscle.find("masseter") != std::string::npos ||
                        row.muscle == "medial pterygoid";
    if (!closes) continue;
    const Vec3 origin = 1e-3 * Eigen::Map<const Vec3>(row.upper_mm);
    const Vec3 insertion = moved * Vec3(1e-3 * Eigen::Map<const Vec3>(row.lower_mm));
    add(kLevel * row.max_force * (origin - insertion).normalized(), insertion, sum);
  }
  return sum;
}

/// Of a run at rest: what a contact puts on the mandible, and where.
struct Support {
  Vec3 force, at;
};

Vec3 last(const ScenarioResults& results, const std::string& what, const std::string& unit) {
  const auto along = [&](const char* axis) {
    return results.last(what + "." + axis + " [" + unit + "]");
  };
  return {along("x"), along("y"), along("z")};
}

/// @param sign  -1 where the mandible is the second body of the probe
Support support(const ScenarioResults& results, const std::string& probe, double sign) {
  return {sign * last(results, probe + ".force", "N"),
          1e-3 * last(results, probe + ".center", "mm")};
}

ScenarioResults isometric(const std::string& file, std::vector<std::string> more = {}) {
  more.insert(more.end(),
              {"duration=" + std::to_string(kLevel) + " s", "muscle_table.0.force_length=false"});
  return run_scenario("mandible/" + file, more);
}

// No ligament is taut in these bites, and nothing rubs. What is left is the couple that pressures
// in different directions make about the middle of their contact: 0.05 % of the whole on the joints
// of a bite on one side, and hardly anything about the axis.
constexpr double kOfBite = 1e-4, kOfWhole = 1e-3;

/// The bite's size from moments about the axis through both joints' points, the joints' forces from
/// moments about each other's point and the balance of forces.
void expect_levers(const ScenarioResults& results, const std::string& bite_probe) {
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const Support bite = support(results, bite_probe, -1);
  const std::array<Support, 2> joint = {support(results, "joint_left", 1),
                                        support(results, "joint_right", 1)};
  Wrench sum = closers(results);
  const Vec3 axis = (joint[0].at - joint[1].at).normalized();
  const Vec3 direction = bite.force.normalized();
  const double lever = (bite.at - joint[0].at).cross(direction).dot(axis);
  const double force = -sum.moment_about(joint[0].at).dot(axis) / lever;
  EXPECT_GT(force, 20);
  EXPECT_NEAR(bite.force.norm(), force, kOfBite * force);

  add(force * direction, bite.at, sum);
  const double whole = sum.force.norm();
  EXPECT_LT((joint[0].force + joint[1].force + sum.force).norm(), kOfBite * whole);
  const Vec3 between = joint[0].at - joint[1].at;
  for (const int side : {0, 1}) {
    // e × R = M for the lever e from the other joint's point; along e moments tell nothing.
    const Vec3 e = side == 0 ? between : Vec3(-between);
    const Vec3 M = -sum.moment_about(joint[static_cast<std::size_t>(1 - side)].at);
    const Vec3 across = M.cross(e) / e.squaredNorm();
    const Vec3 found = joint[static_cast<std::size_t>(side)].force;
    EXPECT_LT((found - found.dot(axis) * axis - across).norm(), kOfWhole * whole);
  }
}

TEST(JawAtRest, ClenchingFollowsTheRuleOfLevers) {
  const ScenarioResults results = isometric("clench.toml");
  expect_levers(results, "teeth");
  const double whole = results.last("teeth.force.z [N]");
  EXPECT_NEAR(results.last("teeth_left.force.z [N]") + results.last("teeth_right.force.z [N]"),
              whole, 1e-6 * whole);
}

// Left and right alike, whatever the level. People have the middle of the force between the last
// third of the first molar and the first third of the second one, at 30 to 100 % of their strength
// (Hidaka et al. 1999), and more on molars than in front of them.
TEST(JawAtRest, AClenchIsSharedOutOverTheTeethAsInPeople) {
  const ScenarioResults results = run_scenario("mandible/clench.toml");
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const auto of = [&](const std::string& probe) {
    const double left = std::abs(results.last(probe + "_left.force.z [N]")),
                 right = std::abs(results.last(probe + "_right.force.z [N]"));
    EXPECT_NEAR(left, right, 1e-6 * (1 + left)) << probe;
    return left;
  };
  const double front = of("front_teeth"), premolars = of("premolars"),
               molars = of("first_molar") + of("second_molar"),
               side = std::abs(results.last("teeth_left.force.z [N]"));
  EXPECT_NEAR(front + premolars + molars, side, 1e-6 * side);
  EXPECT_GT(premolars, 0.05 * side);
  EXPECT_GT(of("first_molar"), 0.2 * side);
  EXPECT_LT(of("second_molar"), 0.7 * side);
  for (const double level : {0.3, 0.6, 1.0}) {
    const double y = results.at("teeth_left.center.y [mm]", level);
    EXPECT_GT(y, -15.0) << level;
    EXPECT_LT(y, -8.0) << level;
  }
}

const std::vector<std::string> kIncisors = {
    "body.upper_molars.geometry.place.translation=0 -45.47 50.7 mm",
    "body.bolus.geometry.place.translation=0 -45 45.2 mm", "attach.0.region.box.1=100 100 43.1 mm"};

const std::vector<std::string> kPremolars = {
    "body.upper_molars.geometry.place.translation=20.5 -20.52 52.82 mm",
    "body.bolus.geometry.place.translation=20.5 -20.05 47.32 mm",
    "attach.0.region.box.1=100 100 45.22 mm"};

TEST(JawAtRest, ABiteOnOnePremolarFollowsTheRuleOfLevers) {
  expect_levers(isometric("bite.toml", kPremolars), "bite");
}

// Muscles that pull alike on both sides meet the bite plane in front of the line from that molar to
// the joint of the other side. So the joint of the molar's side lifts off, and the other one and
// the bite alone hold the jaw.
TEST(JawAtRest, ABiteOnOneMolarUnloadsTheJointOfItsSide) {
  const ScenarioResults results = isometric("bite.toml");
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const Support bite = support(results, "bite", -1), joint = support(results, "joint_right", 1);
  Wrench sum = closers(results);
  const double whole = sum.force.norm(), lever = (bite.at - joint.at).norm();
  add(bite.force, bite.at, sum);
  EXPECT_LT(last(results, "joint_left.force", "N").norm(), 1e-6 * whole);
  EXPECT_GT(bite.force.norm(), joint.force.norm());
  EXPECT_LT((sum.force + joint.force).norm(), kOfBite * whole);
  EXPECT_LT(sum.moment_about(joint.at).norm(), kOfWhole * whole * lever);
}

TEST(JawAtRest, ABiteOfTheIncisorsFollowsTheRuleOfLevers) {
  expect_levers(isometric("bite.toml", kIncisors), "bite");
}

/// Up to the largest force of all closers, in ten load steps. Levers change little on the way, as
/// discs and periodontal ligaments give way: the bite grows nearly as the level does.
/// @param iterations  at most, a load step
void expect_full_bite(const std::vector<std::string>& where, int iterations) {
  const ScenarioResults results = run_scenario("mandible/bite.toml", where);
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  EXPECT_LE(results.count("newton_iterations"), 10 * iterations);
  const double half = results.at("bite.force.z [N]", 0.5);
  EXPECT_NEAR(results.last("bite.force.z [N]"), 2 * half, 0.04 * std::abs(half));
}

TEST(JawAtRest, FibresHoldTheDiscsInTheHardestBite) {
  expect_full_bite(kPremolars, 10);
  expect_full_bite(kIncisors, 10);
  expect_full_bite({}, 30);  // the disc of the joint that lifts off is loose
}

}  // namespace articular::bite_test
