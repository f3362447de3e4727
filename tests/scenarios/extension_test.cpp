// The knees of scenarios/knee/ with a patella: extension.toml with coarse elements to 30 degrees,
// on the recorded knee too, squat.toml to 90.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/curve.hpp"
#include "tests/scenarios/coarse_knee.hpp"
#include "tests/scenarios/mirrored_knee.hpp"
#include "tests/scenarios/recorded_knee.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::extension_test {

const std::array<std::string, 4> kQuadriceps{"rectus_femoris", "vastus_intermedius",
                                             "vastus_lateralis", "vastus_medialis"};
const std::array<std::string, 3> kTendon{"patellar_tendon_lateral", "patellar_tendon_central",
                                         "patellar_tendon_medial"};

const anatomy::Anatomy& coarse_anatomy() {
  static const anatomy::Anatomy anatomy = anatomy::knee_anatomy({4, 2}, {.patella = true});
  return anatomy;
}

/// To 30 degrees, with both ends of each line at the patella as points.
sim::Scenario to_30_degrees(const std::string& file) {
  sim::Scenario scenario = shipped_scenario(file, {"duration=7 s"});
  const auto add_ends = [&](const std::string& name, const std::vector<sim::Anchor>& path) {
    scenario.probes.push_back({name + "_from", sim::PointProbe{path.front()}});
    scenario.probes.push_back({name + "_to", sim::PointProbe{path.back()}});
  };
  for (const sim::Muscle& muscle : scenario.muscles) add_ends(muscle.name, muscle.path);
  for (const sim::Ligament& ligament : scenario.ligaments)
    if (ligament.name.starts_with("patellar_tendon")) add_ends(ligament.name, ligament.path);
  return scenario;
}

/// All contact faces as the meshes have them.
sim::Scenario short_extension() {
  sim::Scenario scenario = to_30_degrees("knee/extension.toml");
  for (sim::Body& body : scenario.bodies)
    for (sim::MeshFile& file : body.contact_meshes) file.faces.reset();
  return scenario;
}

const ScenarioResults& right_knee() {
  static const ScenarioResults results = knee_test::run_with(coarse_anatomy(), short_extension());
  return results;
}

Vec3 vector_at(const ScenarioResults& results, const std::string& name, const std::string& unit,
               double time) {
  const auto at = [&](const char* axis) {
    return results.at(name + axis + " [" + unit + "]", time);
  };
  return {at(".x"), at(".y"), at(".z")};
}

struct PulledPoint {
  Vec3 point, force;  // [mm], [N]
};
/// What a straight line puts on the patella, at its end there.
PulledPoint pull_on_patella(const ScenarioResults& results, const std::string& line,
                            bool begins_there, double time) {
  const Vec3 from = vector_at(results, line + "_from.position", "mm", time),
             to = vector_at(results, line + "_to.position", "mm", time);
  const double digits = 1e-8 * std::max(to.norm(), 100.0);  // of the table, which has nine
  EXPECT_NEAR((to - from).norm(), results.at(line + ".length [mm]", time), digits) << line;
  const double force = results.at(line + ".force [N]", time);
  const Vec3 along = force * (to - from).normalized();
  return begins_there ? PulledPoint{from, along} : PulledPoint{to, -along};
}

void expect_balance_of_the_patella(const ScenarioResults& knee, const std::vector<double>& times) {
  EXPECT_EQ(knee.summary().at("outcome"), "finished");
  for (const double time : times) {
    const Vec3 center = vector_at(knee, "patellofemoral.center", "mm", time);
    Vec3 force = vector_at(knee, "patellofemoral.force", "N", time);
    Vec3 moment = 1e3 * vector_at(knee, "patellofemoral.moment", "N m", time);  // [N mm]
    EXPECT_GT(force.norm(), 20);
    double pull = 0;
    const auto add = [&](const PulledPoint& pulled) {
      force += pulled.force;
      moment += (pulled.point - center).cross(pulled.force);
      pull += pulled.force.norm();
    };
    for (const std::string& line : kQuadriceps) add(pull_on_patella(knee, line, false, time));
    for (const std::string& line : kTendon) add(pull_on_patella(knee, line, true, time));
    EXPECT_LT(force.norm(), 1e-3 * pull) << time;
    EXPECT_LT(moment.norm(), 1e-3 * pull * 20) << time;  // arms of about 20 mm
  }
}

double force_of_all(const ScenarioResults& knee, std::span<const std::string> lines, double time) {
  double force = 0;
  for (const std::string& line : lines) force += knee.at(line + ".force [N]", time);
  return force;
}

void expect_balance_at_full_activation(const ScenarioResults& knee) {
  expect_balance_of_the_patella(knee, {1, 4, 7});
  for (const double time : {1.0, 4.0, 7.0})
    EXPECT_NEAR(force_of_all(knee, kQuadriceps, time), 400, 1e-6);
}

TEST(KneeExtension, ForcesAndMomentsOnThePatellaBalance) {
  expect_balance_at_full_activation(right_knee());
}

double tendon_ratio(const ScenarioResults& knee, double time) {
  return force_of_all(knee, kTendon, time) / force_of_all(knee, kQuadriceps, time);
}

// Buff et al. 1988: the quadriceps pulls with 0.86 of the tendon's force at 10 degrees, and with
// more and more from there.
TEST(KneeExtension, TheTendonPullsAboutAsTheQuadricepsNearExtensionAndLessWithFlexion) {
  EXPECT_NEAR(tendon_ratio(right_knee(), 3), 1 / 0.86, 0.2);
  for (const int time : {2, 3, 4, 5, 6})
    EXPECT_GT(tendon_ratio(right_knee(), time), tendon_ratio(right_knee(), time + 1)) << time;
}

// A body of fibres between patella and tuberosity pulls with what its lines pull with.
TEST(KneeExtension, ATendonOfTissuePullsAsItsLines) {
  sim::Scenario scenario =
      shipped_scenario("knee/extension.toml", {"duration=1 s", "choice.tendon=tissue"});
  for (sim::Body& body : scenario.bodies)
    for (sim::MeshFile& file : body.contact_meshes) file.faces.reset();
  const ScenarioResults tissue = knee_test::run_with(
      anatomy::knee_anatomy({4, 2}, {.patella = true, .ligaments = true}), scenario);
  EXPECT_EQ(tissue.summary().at("outcome"), "finished");
  const double pull = vector_at(tissue, "patellar_tendon.force", "N", 1).norm();
  EXPECT_NEAR(pull, 400 * tendon_ratio(right_knee(), 1), 20);
  EXPECT_GT(tissue.last("patellar_tendon_fibres.stretch [-]"), 1.01);
  EXPECT_LT(tissue.last("patellar_tendon_fibres.stretch [-]"), 1.04);
  EXPECT_NEAR(tissue.last("tibia.moment.x [N m]"), right_knee().at("tibia.moment.x [N m]", 1), 1);
}

void expect_patella_in_its_groove(const ScenarioResults& knee) {
  EXPECT_NEAR(knee.last("knee.flexion [deg]"), 30, 1e-6);
  EXPECT_GT(knee.last("patella.flexion [deg]"), 10);
  EXPECT_LT(knee.last("patella.flexion [deg]"), 30);
  for (const int time : {1, 2, 3, 4, 5, 6, 7}) {
    EXPECT_LT(std::abs(knee.at("patella.lateral [mm]", time)), 5) << time;
    EXPECT_LT(std::abs(knee.at("patella.internal_rotation [deg]", time)), 10) << time;
  }
}

TEST(KneeExtension, ThePatellaStaysInItsGrooveAndFlexesLessThanTheKnee) {
  expect_patella_in_its_groove(right_knee());
}

// What the tibia is held with is what the tendon turns it with: 31 to 47 mm times the quadriceps'
// force in living knees (PMC4662057), from 50 to 10 degrees.
TEST(KneeExtension, TheQuadricepsExtendsTheKneeWithAMomentArmOfAFewCentimetres) {
  const double arm = 1e3 * std::abs(right_knee().at("tibia.moment.x [N m]", 7)) / 400;  // [mm]
  EXPECT_GT(arm, 25);
  EXPECT_LT(arm, 55);
}

const std::array<std::string, 4> kHamstrings{"biceps_femoris_long", "biceps_femoris_short",
                                             "semimembranosus", "semitendinosus"};

/// How much shorter a line gets by a radian of flexion, about 30 degrees. [mm]
double arm_by_travel(const ScenarioResults& knee, const std::string& line) {
  const double radian = 2.5 * 3.14159265 / 180;
  const auto length = [&](double time) { return knee.at(line + ".length [mm]", time); };
  return (length(6.5) - length(7)) / radian;
}

// Spoor and van Leeuwen 1992: 20 to 55 mm, and 12 to 20 mm of the gastrocnemius.
TEST(KneeExtension, FlexorsHaveTheArmsOfMeasuredOnes) {
  for (const std::string& line : kHamstrings) {
    EXPECT_GT(arm_by_travel(right_knee(), line), 14) << line;
    EXPECT_LT(arm_by_travel(right_knee(), line), 55) << line;
  }
  for (const std::string line : {"gastrocnemius_medial", "gastrocnemius_lateral"})
    EXPECT_NEAR(arm_by_travel(right_knee(), line), 18, 6) << line;
  EXPECT_GT(arm_by_travel(right_knee(), "semitendinosus"),
            arm_by_travel(right_knee(), "semimembranosus"));
}

// Hamstrings draw the tibia backwards: they relieve the ACL, press the joint together, and take
// their forces times their arms from the moment that holds the tibia.
TEST(KneeExtension, HamstringsRelieveTheAclAndFlexTheKneeByTheirArms) {
  sim::Scenario scenario = short_extension();
  for (sim::Muscle& muscle : scenario.muscles)
    for (const std::string& line : kHamstrings)
      if (muscle.name == line) muscle.excitation.value = {0, 1};
  const ScenarioResults both = knee_test::run_with(coarse_anatomy(), scenario);
  EXPECT_EQ(both.summary().at("outcome"), "finished");
  const ScenarioResults& alone = right_knee();
  const auto acl = [](const ScenarioResults& knee) {
    return knee.last("acl_anterior.force [N]") + knee.last("acl_posterior.force [N]");
  };
  EXPECT_LT(acl(both), 0.7 * acl(alone));
  EXPECT_GT(vector_at(both, "tibiofemoral.force", "N", 7).norm(),
            vector_at(alone, "tibiofemoral.force", "N", 7).norm() + 30);
  double by_arms = 0;  // [N m]
  for (const std::string& line : kHamstrings) {
    EXPECT_EQ(alone.last(line + ".force [N]"), 0) << line;
    by_arms += 1e-3 * both.last(line + ".force [N]") * arm_by_travel(both, line);
  }
  EXPECT_GT(by_arms, 3);
  EXPECT_NEAR(both.last("tibia.moment.x [N m]") - alone.last("tibia.moment.x [N m]"), by_arms,
              0.25 * by_arms);
}

// Menisci are wedges behind the condyles: they take a part of what draws the tibia forwards.
TEST(KneeExtension, MenisciRelieveTheAcl) {
  sim::Scenario scenario =
      shipped_scenario("knee/extension.toml", {"duration=1 s", "choice.menisci=both"});
  for (sim::Body& body : scenario.bodies)
    for (sim::MeshFile& file : body.contact_meshes) file.faces.reset();
  const ScenarioResults menisci = knee_test::run_with(coarse_anatomy(), scenario);
  EXPECT_EQ(menisci.summary().at("outcome"), "finished");
  const auto acl = [](const ScenarioResults& knee) {
    return knee.at("acl_anterior.force [N]", 1) + knee.at("acl_posterior.force [N]", 1);
  };
  EXPECT_LT(acl(menisci), 0.9 * acl(right_knee()));
  double forwards = 0;  // on the femur
  for (const std::string side : {"medial", "lateral"})
    forwards -= menisci.last("above_meniscus_" + side + ".force.y [N]");
  EXPECT_GT(forwards, 15);
}

// The tendon leaves the shank forwards in extension and swings back with flexion, as in living
// knees (DeFrate et al. 2007).
TEST(KneeExtension, TheTendonSwingsBackwardsAsTheKneeFlexes) {
  const auto angle_deg = [](double time) {
    const Vec3 along = vector_at(right_knee(), "apex.position", "mm", time) -
                       vector_at(right_knee(), "tuberosity.position", "mm", time);
    return std::atan2(-along.y(), along.z()) * 180 / 3.14159265;
  };
  EXPECT_NEAR(angle_deg(1), 18, 6);
  for (const int time : {2, 3, 4, 5, 6}) EXPECT_GT(angle_deg(time), angle_deg(time + 1)) << time;
}

const ScenarioResults& squat() {
  static const ScenarioResults results = run_scenario("knee/squat.toml", {});
  return results;
}

// The ground's force passes farther and farther behind the knee; the quadriceps of the file leaves
// the tibia's hold next to nothing of its moment and that of the flexors, which is 13 N m at 30
// and 23 at 40 degrees.
TEST(KneeSquat, TheQuadricepsBalancesTheGround) {
  const ScenarioResults& knee = squat();
  EXPECT_EQ(knee.summary().at("outcome"), "finished");
  EXPECT_NEAR(knee.last("knee.flexion [deg]"), 90, 1e-6);
  double before = 0;
  for (const double time : {7.0, 9.0, 13.0, 17.0, 19.0}) {
    EXPECT_LT(std::abs(knee.at("tibia.moment.x [N m]", time)), 0.3) << time;
    const double force = vector_at(knee, "patellofemoral.force", "N", time).norm();
    EXPECT_GT(force, before + 100) << time;
    before = force;
    // Ground, tendon and flexors press the joint together.
    EXPECT_GT(vector_at(knee, "tibiofemoral.force", "N", time).norm(), 700) << time;
    for (const char* const line : {"semimembranosus", "gastrocnemius_medial"})
      EXPECT_GT(knee.at(std::string(line) + ".force [N]", time), 50) << line;
  }
}

// The heel goes down as the shank leans: the fibres have the length of the path and of what the
// ankle adds, less the tendon.
TEST(KneeSquat, TheGastrocnemiusPullsByTheLengthOfItsFibres) {
  const sim::Scenario scenario = shipped_scenario("knee/squat.toml");
  for (const sim::Muscle& muscle : scenario.muscles) {
    if (!muscle.name.starts_with("gastrocnemius")) continue;
    EXPECT_GT(sim::value_at(muscle.beyond, 19), sim::value_at(muscle.beyond, 1) + 0.015);
    for (const double time : {1.0, 7.0, 13.0, 19.0}) {
      const double optimal = *muscle.optimal_length,
                   length = 1e-3 * squat().at(muscle.name + ".length [mm]", time) +
                            sim::value_at(muscle.beyond, time);
      const double n = 1 + (length / optimal - 1) / (1 - muscle.tendon_ratio);
      ASSERT_GT(n, 0.6);
      ASSERT_LT(n, 1.4);
      const double active = 0.08 * (1 - 4 * (n - 1) * (n - 1)),
                   passive = muscle.passive_fraction *
                             std::max(0.0, (length / optimal - 1) / (muscle.max_length_ratio - 1));
      EXPECT_NEAR(squat().at(muscle.name + ".force [N]", time),
                  muscle.max_force * (active + passive), 1e-5 * muscle.max_force)
          << muscle.name << time;
    }
  }
}

TEST(KneeExtension, ALeftKneeIsTheMirrorImage) {
  const ScenarioResults left = knee_test::run_with(knee_test::mirrored(coarse_anatomy()),
                                                   knee_test::mirrored(short_extension()));
  const ScenarioResults& right = right_knee();
  EXPECT_EQ(left.summary().at("outcome"), "finished");
  for (const char* const column :
       {"knee.internal_rotation [deg]", "knee.abduction [deg]", "patella.lateral [mm]",
        "patella.internal_rotation [deg]", "patella.flexion [deg]"})
    EXPECT_NEAR(left.last(column), right.last(column), 1e-3) << column;
  for (const std::string& line : kTendon)
    EXPECT_NEAR(left.last(line + ".force [N]"), right.last(line + ".force [N]"), 0.01) << line;
  EXPECT_NEAR(left.last("patellofemoral.force.x [N]"), -right.last("patellofemoral.force.x [N]"),
              0.01);
}

#ifdef ARTICULAR_MESHER
TEST(KneeExtension, OnARecordedKneeThePatellaBalancesInItsGrooveToo) {
  if (!knee_test::has_recorded_anatomy())
    GTEST_SKIP() << "ARTICULAR_DATA does not name the real anatomy";
  const ScenarioResults knee =
      knee_test::run_recorded_knee(to_30_degrees("knee/subject-extension.toml"));
  expect_balance_at_full_activation(knee);
  expect_patella_in_its_groove(knee);
  EXPECT_NEAR(tendon_ratio(knee, 3), 1 / 0.86, 0.2);  // near 15 degrees, where this knee begins
}

TEST(KneeSquat, OnARecordedKneeTheQuadricepsBalancesTheGroundToo) {
  if (!knee_test::has_recorded_anatomy())
    GTEST_SKIP() << "ARTICULAR_DATA does not name the real anatomy";
  const ScenarioResults knee =
      knee_test::run_recorded_knee(to_30_degrees("knee/subject-squat.toml"));
  expect_balance_of_the_patella(knee, {6, 7});
  expect_patella_in_its_groove(knee);
  // Of 6 N m. With the elements of the file, which are smaller, next to none is left.
  EXPECT_LT(std::abs(knee.last("tibia.moment.x [N m]")), 1);
  EXPECT_NEAR(tendon_ratio(knee, 7), 0.9, 0.15);
}
#endif

}  // namespace articular::extension_test
