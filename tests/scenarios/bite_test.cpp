// Clench and bite of scenarios/mandible/ beside the rule of levers.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <string>

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
  EXPECT_NEAR(bite.force.norm(), force, 0.02 * force);

  add(force * direction, bite.at, sum);
  const double whole = sum.force.norm();
  EXPECT_LT((joint[0].force + joint[1].force + sum.force).norm(), 0.02 * whole);
  const Vec3 between = joint[0].at - joint[1].at;
  for (const int side : {0, 1}) {
    // e × R = M for the lever e from the other joint's point; along e moments tell nothing.
    const Vec3 e = side == 0 ? between : Vec3(-between);
    const Vec3 M = -sum.moment_about(joint[static_cast<std::size_t>(1 - side)].at);
    const Vec3 across = M.cross(e) / e.squaredNorm();
    const Vec3 found = joint[static_cast<std::size_t>(side)].force;
    EXPECT_LT((found - found.dot(axis) * axis - across).norm(), 0.02 * whole);
  }
}

TEST(JawAtRest, ClenchingFollowsTheRuleOfLevers) {
  const ScenarioResults results = isometric("clench.toml");
  expect_levers(results, "teeth");
  const double whole = results.last("teeth.force.z [N]");
  EXPECT_NEAR(results.last("teeth_left.force.z [N]") + results.last("teeth_right.force.z [N]"),
              whole, 1e-6 * whole);
}

TEST(JawAtRest, ABiteOnOneMolarFollowsTheRuleOfLevers) {
  expect_levers(isometric("bite.toml"), "bite");
}

TEST(JawAtRest, ABiteOfTheIncisorsFollowsTheRuleOfLevers) {
  expect_levers(isometric("bite.toml", {"body.bolus.geometry.place.translation=0 -45 45.2 mm",
                                        "attach.0.region.box.0=-100 -100 47 mm"}),
                "bite");
}

}  // namespace articular::bite_test
