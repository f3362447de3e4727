// The knees of scenarios/knee/, with coarse elements and part of the load.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/build/build_model.hpp"
#include "sim/run/run.hpp"
#include "tests/scenarios/coarse_knee.hpp"
#include "tests/scenarios/mirrored_knee.hpp"
#include "tests/scenarios/recorded_knee.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::knee_test {

const std::vector<std::string> kLigaments{"acl_anterior.force [N]",
                                          "acl_posterior.force [N]",
                                          "pcl_anterior.force [N]",
                                          "pcl_posterior.force [N]",
                                          "lcl_anterior.force [N]",
                                          "lcl_superior.force [N]",
                                          "lcl_posterior.force [N]",
                                          "popliteofibular.force [N]",
                                          "popliteus.force [N]",
                                          "mcl_anterior.force [N]",
                                          "mcl_intermediate.force [N]",
                                          "mcl_posterior.force [N]",
                                          "deep_mcl_anterior.force [N]",
                                          "deep_mcl_posterior.force [N]",
                                          "posterior_oblique.force [N]",
                                          "capsule_medial_inner.force [N]",
                                          "capsule_medial_outer.force [N]",
                                          "capsule_lateral_inner.force [N]",
                                          "capsule_lateral_outer.force [N]"};
/// [N] The limit of easy flexion.
constexpr double kEasy = 100;
/// The recorded knee has no capsule.
const std::vector<std::string> kRecordedLigaments(kLigaments.begin(), kLigaments.end() - 4);

/// @param duration   [s], 1000 N each
/// @param cartilage  the word of that choice
ScenarioResults loaded_knee(double duration, const std::string& cartilage = "tissue") {
  return coarse_knee("axial-load.toml", {"duration=" + std::to_string(duration) + " s",
                                         "choice.cartilage=" + cartilage});
}

TEST(KneeAxialLoad, IsTheSameByEitherTree) {
  const auto knee = [](const std::string& tree) {
    return coarse_knee("axial-load.toml",
                       {"duration=0.05 s", "choice.cartilage=layer", "detection.tree=" + tree});
  };
  const ScenarioResults blocks = knee("blocks"), buckets = knee("buckets");
  EXPECT_GT(blocks.count("reported_pairs"), 0);
  EXPECT_EQ(blocks.count("reported_pairs"), buckets.count("reported_pairs"));
  EXPECT_EQ(blocks.count("newton_iterations"), buckets.count("newton_iterations"));
  for (const char* const column : {"femur.force.z [N]", "cartilage_medial.force.z [N]"})
    EXPECT_EQ(blocks.column(column), buckets.column(column)) << column;
}

double sum_of(const ScenarioResults& results, const std::vector<std::string>& columns) {
  double sum = 0;
  for (const std::string& column : columns) sum += results.column(column).back();
  return sum;
}

double sum_at(const ScenarioResults& results, const std::vector<std::string>& columns,
              double time) {
  double sum = 0;
  for (const std::string& column : columns) sum += results.at(column, time);
  return sum;
}

/// The names of all lines that end at the tibia, each with its force, the place there and the next
/// one on its way, as probes NAME_on_tibia, NAME_at_tibia and NAME_beside_tibia.
std::vector<std::string> add_ends_at_tibia(sim::Scenario& scenario) {
  std::vector<std::string> lines;
  for (const sim::Ligament& ligament : scenario.ligaments)
    for (std::size_t i = 1; i < ligament.path.size(); ++i) {
      const sim::Anchor &beside = ligament.path[i - 1], &at = ligament.path[i];
      if (at.body != "tibia" || beside.body == "tibia") continue;
      scenario.probes.push_back({ligament.name + "_on_tibia", sim::LineProbe{ligament.name}});
      scenario.probes.push_back({ligament.name + "_at_tibia", sim::PointProbe{at}});
      scenario.probes.push_back({ligament.name + "_beside_tibia", sim::PointProbe{beside}});
      lines.push_back(ligament.name);
    }
  return lines;
}

/// What straight lines put on the tibia, upwards. [N]
double pull_on_tibia(const ScenarioResults& results, const std::vector<std::string>& lines) {
  double sum = 0;
  for (const std::string& line : lines) {
    const auto place = [&](const char* end) {
      Vec3 x;
      for (int i = 0; i < 3; ++i)
        x[i] = results.last(line + end + ".position." + "xyz"[i] + " [mm]");
      return x;
    };
    const Vec3 along = place("_beside_tibia") - place("_at_tibia");
    sum += results.last(line + "_on_tibia.force [N]") * along.normalized().z();
  }
  return sum;
}

TEST(KneeAxialLoad, ContactAndLigamentsBalanceTheLoad) {
  const double load = 200;  // [N]
  sim::Scenario scenario = shipped_scenario("knee/axial-load.toml", {"duration=0.2 s"});
  const std::vector<std::string> lines = add_ends_at_tibia(scenario);
  // Elements are those shipped: coarse menisci leave so much room that horns hardly pull at 200 N.
  const ScenarioResults results = run_scenario(scenario);
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  EXPECT_GT(results.count("reported_pairs"), 0);
  // What holds the femur carries the load, along the tibia and nowhere else.
  EXPECT_NEAR(results.column("femur.force.z [N]").back(), load, 1e-3 * load);
  EXPECT_LT(std::abs(results.column("femur.force.x [N]").back()), 1e-3 * load);
  EXPECT_LT(std::abs(results.column("femur.force.y [N]").back()), 1e-3 * load);
  // Contact passes from the femur's cartilage into the bone; ligaments press the joint together
  // too.
  const double contact =
      sum_of(results, {"cartilage_medial.force.z [N]", "cartilage_lateral.force.z [N]",
                       "above_meniscus_medial.force.z [N]", "above_meniscus_lateral.force.z [N]"});
  const double rigid = sum_of(
      results, {"cartilage_of_femur_medial.force.z [N]", "cartilage_of_femur_lateral.force.z [N]"});
  EXPECT_NEAR(contact, rigid, 1e-3 * load);
  // On the tibia contact presses against the load and all lines. Those around a condyle are slack.
  const double on_tibia =
      sum_of(results, {"cartilage_medial.force.z [N]", "cartilage_lateral.force.z [N]",
                       "below_meniscus_medial.force.z [N]", "below_meniscus_lateral.force.z [N]"});
  for (const char* const line : {"capsule_medial_inner", "capsule_medial_outer",
                                 "capsule_lateral_inner", "capsule_lateral_outer"})
    EXPECT_EQ(results.last(line + std::string(".force [N]")), 0) << line;
  EXPECT_NEAR(on_tibia, load + pull_on_tibia(results, lines), 1e-3 * load);
  // Horns are drawn apart, and their roots hold them.
  for (const char* root :
       {"medial_anterior", "medial_posterior", "lateral_anterior", "lateral_posterior"})
    EXPECT_GT(sum_of(results, {fmt::format("root_{}_inner.force [N]", root),
                               fmt::format("root_{}_outer.force [N]", root)}),
              3)
        << root;
  const double ligaments = sum_of(results, kLigaments);
  EXPECT_GT(contact, load);
  EXPECT_LT(contact, load + ligaments);
  // Both menisci and both pairs of cartilage carry.
  for (const char* side : {"medial", "lateral"}) {
    EXPECT_GT(results.column(std::string("above_meniscus_") + side + ".force.z [N]").back(), 10);
    EXPECT_LT(results.column(std::string("below_meniscus_") + side + ".area [mm^2]").back(), 1000);
  }
  const double menisci =
      sum_of(results, {"above_meniscus_medial.force.z [N]", "above_meniscus_lateral.force.z [N]"});
  EXPECT_NEAR(results.last("menisci_above.share [-]"), menisci / contact, 1e-7);
  // Flexion is what both holds leave out.
  EXPECT_LT(std::abs(results.last("knee.flexion [deg]")), 1e-9);
  EXPECT_LT(std::abs(results.last("knee.abduction [deg]")), 2);
  EXPECT_GT(std::abs(results.last("knee.abduction [deg]")), 1e-6);
  EXPECT_LT(results.summary().at("max_penetration_m").get<double>(), 0.02e-3);
}

// Numbers of the nodes are others in a mirrored mesh only in the order of the corners, so that it
// takes the same iterations.
TEST(KneeAxialLoad, ALeftKneeIsTheMirrorImage) {
  const std::vector<std::string> short_form = {"duration=0.05 s", "integrator.step=0.05 s"};
  const anatomy::Anatomy anatomy = anatomy::knee_anatomy({4, 2});
  const sim::Scenario scenario = shipped_scenario("knee/axial-load.toml", short_form);
  const ScenarioResults right = run_with(anatomy, scenario),
                        left = run_with(mirrored(anatomy), mirrored(scenario));
  EXPECT_EQ(left.summary().at("outcome"), "finished");
  for (const char* const column :
       {"knee.internal_rotation [deg]", "knee.abduction [deg]", "knee.anterior [mm]",
        "extrusion_medial.largest [mm]", "extrusion_lateral.largest [mm]"})
    EXPECT_NEAR(left.last(column), right.last(column), 2e-3) << column;
  for (const char* const column :
       {"above_meniscus_medial.force.z [N]", "above_meniscus_lateral.force.z [N]",
        "root_medial_posterior_inner.force [N]", "transverse_ligament.force [N]"})
    EXPECT_NEAR(left.last(column), right.last(column), 0.1) << column;
}

// Cartilage as an elastic layer on rigid bones: no unknowns but those of the menisci and the bones.
TEST(KneeAxialLoad, WithCartilageAsALayerContactAndLigamentsBalanceTheLoadToo) {
  const double load = 100;  // [N]
  const ScenarioResults results = loaded_knee(0.1, "layer");
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  EXPECT_NEAR(results.last("femur.force.z [N]"), load, 1e-3 * load);
  const double contact =
      sum_of(results, {"cartilage_medial.force.z [N]", "cartilage_lateral.force.z [N]",
                       "above_meniscus_medial.force.z [N]", "above_meniscus_lateral.force.z [N]"});
  EXPECT_GT(contact, load);
  EXPECT_GT(results.last("above_meniscus_medial.force.z [N]"), 10);
  EXPECT_GT(results.last("above_meniscus_lateral.force.z [N]"), 10);
}

// Flexion is what the femur's motion says, however the other five freedoms go; the femur's hold
// carries the load and, about the axis of flexion, what turns it.
TEST(KneeFlexion, ADrivenFemurFlexesTheLoadedKneeAndTheOtherFreedomsFollow) {
  const ScenarioResults results = run_scenario("knee/flexion.toml", {"duration=0.22 s"});
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  EXPECT_NEAR(results.last("knee.flexion [deg]"), 4, 1e-6);
  const double load = 200;  // [N]
  EXPECT_NEAR(results.last("femur.force.z [N]"), load, 1e-3 * load);
  EXPECT_LT(std::abs(results.last("femur.force.x [N]")), 1e-3 * load);
  EXPECT_LT(std::abs(results.last("femur.moment.y [N m]")), 1e-12);  // free
  EXPECT_GT(std::abs(results.last("femur.moment.x [N m]")), 0.01);
  EXPECT_GT(results.last("above_meniscus_medial.force.z [N]"), 10);
  EXPECT_GT(results.last("above_meniscus_lateral.force.z [N]"), 10);
  EXPECT_LT(std::abs(results.last("knee.abduction [deg]")), 2);
  EXPECT_GT(std::abs(results.last("knee.internal_rotation [deg]")), 0.1);
  // The condyles roll back and take the menisci along, those of the shipped size: coarse ones leave
  // the condyle more room.
  for (const char* const side : {"medial", "lateral"})
    for (const char* const edge : {"least", "largest"}) {
      const std::string column = fmt::format("posterior_{}.{} [mm]", side, edge);
      EXPECT_GT(results.last(column), results.at(column, 0.1) + 0.1) << column;
    }
}

// What a meniscus carried goes through less cartilage without it, and the other compartment has
// hardly another load. Elements are those shipped: 100 N do not close the room that coarse menisci
// leave for their chords.
TEST(KneeAxialLoad, WithoutAMeniscusItsCompartmentHasLessAreaAndMorePressure) {
  const auto knee = [](const std::string& menisci) {
    return run_scenario("knee/axial-load.toml",
                        {"duration=0.1 s", "choice.cartilage=layer", "choice.menisci=" + menisci});
  };
  const ScenarioResults both = knee("both"), lateral = knee("lateral"), none = knee("none");
  for (const ScenarioResults* results : {&both, &lateral, &none})
    EXPECT_EQ(results->summary().at("outcome"), "finished");
  const char* const pressure = "cartilage_medial.max_face_pressure [Pa]";
  EXPECT_GT(lateral.last(pressure), 1.2 * both.last(pressure));
  EXPECT_LT(
      lateral.last("cartilage_medial.area [mm^2]"),
      0.8 * sum_of(both, {"cartilage_medial.area [mm^2]", "below_meniscus_medial.area [mm^2]"}));
  EXPECT_NEAR(lateral.last("medial.share [-]"), both.last("medial.share [-]"), 0.1);
  EXPECT_NEAR(none.last("femur.force.z [N]"), 100, 0.1);
  EXPECT_GT(none.last("cartilage_lateral.max_face_pressure [Pa]"),
            1.2 * both.last("cartilage_lateral.max_face_pressure [Pa]"));
}

TEST(KneeAxialLoad, WithATornRootTheMeniscusIsPressedOut) {
  const auto knee = [](const std::string& torn) {
    return coarse_knee("axial-load.toml", {"duration=0.1 s", "choice.cartilage=layer", torn});
  };
  const ScenarioResults whole = knee("choice.medial_roots=both");
  for (const std::string side : {"medial", "lateral"}) {
    const std::string extrusion = "extrusion_" + side + ".largest [mm]";
    EXPECT_GT(knee("choice." + side + "_roots=anterior").last(extrusion),
              whole.last(extrusion) + 0.2)
        << side;
  }
}

// Passive flexion is easy, and the knee gives way as measured ones do (sources:
// scenarios/SOURCES.md). The fit had other elements.
TEST(KneeLaxity, TheKneeBendsEasilyAndItsDrawerIsNearlyAsMeasured) {
  const ScenarioResults results = coarse_knee("laxity.toml", {});
  const struct {
    double rest, drawer, spread;  // [s], [mm]
  } angles[] = {{1, 4.0, 1.4}, {16, 6.0, 2.5}, {31, 4.7, 2.4}, {46, 3.8, 2.5}};
  for (const auto& [rest, drawer, spread] : angles) {
    EXPECT_LT(sum_at(results, kLigaments, rest), kEasy) << rest;
    EXPECT_LT(std::abs(results.at("femur.moment.x [N m]", rest)), 1) << rest;
    const double forwards =
        results.at("knee.anterior [mm]", rest + 1) - results.at("knee.anterior [mm]", rest);
    EXPECT_NEAR(forwards, drawer, 1.4 * spread) << rest;
  }
  EXPECT_EQ(results.count("rejected_motion"), 0);
  // Every five degrees on the way.
  for (const double begin : {13, 28, 43})
    for (int step = 0; step <= 6; ++step)
      EXPECT_LT(sum_at(results, kLigaments, begin + 0.5 * step), kEasy) << begin << ", " << step;
  // On to 100 degrees, as easily.
  EXPECT_NEAR(results.last("knee.flexion [deg]"), 100, 1e-6);
  EXPECT_LT(sum_of(results, kLigaments), kEasy);
  EXPECT_LT(std::abs(results.last("femur.moment.x [N m]")), 1);
}

// What each structure is for: the popliteus and its ligament are pulled by a turn outwards, the
// posterior oblique ligament by one inwards, the MCL by valgus, the LCL by varus. The capsule,
// which goes round the condyles, is slack from 30 degrees on.
TEST(KneeLaxity, EachStructureIsPulledWhereItHoldsTheKnee) {
  const ScenarioResults results = coarse_knee("laxity.toml", {"duration=28 s"});
  const auto force = [&](const std::string& line, double time) {
    return results.at(line + ".force [N]", time);
  };
  EXPECT_GT(force("popliteus", 23) + force("popliteofibular", 23), 10);
  EXPECT_LT(force("popliteus", 21) + force("popliteofibular", 21), 1);
  EXPECT_GT(force("posterior_oblique", 6), force("posterior_oblique", 8) + 10);
  EXPECT_GT(force("mcl_intermediate", 10), force("mcl_intermediate", 12) + 10);
  EXPECT_GT(force("lcl_posterior", 12), force("lcl_posterior", 10) + 10);
  for (const char* const line : {"capsule_medial_inner", "capsule_medial_outer",
                                 "capsule_lateral_inner", "capsule_lateral_outer"})
    for (const double time : {16, 17, 19, 21, 23, 25, 27}) EXPECT_EQ(force(line, time), 0) << line;
}

// ACL and superficial MCL as bodies of fibres in place of their lines: no element is inside out,
// the ACL gets taut, and the knee gives way by about as much.
TEST(KneeLaxity, LigamentsOfTissueHoldTheKneeAsTheirLinesDo) {
  const std::vector<std::string> short_form = {"duration=2 s"};
  std::vector<std::string> of_tissue = short_form;
  for (const char* choice : {"choice.acl=tissue", "choice.mcl=tissue"})
    of_tissue.emplace_back(choice);
  const ScenarioResults lines = coarse_knee("laxity.toml", short_form),
                        tissue = coarse_knee("laxity.toml", of_tissue);
  EXPECT_TRUE(tissue.summary().at("warnings").empty()) << tissue.summary().at("warnings");
  const auto drawer = [](const ScenarioResults& results) {
    return results.at("knee.anterior [mm]", 2) - results.at("knee.anterior [mm]", 1);
  };
  EXPECT_NEAR(drawer(tissue), drawer(lines), 1.5);
  EXPECT_GT(drawer(tissue), 0.5);
  EXPECT_GT(tissue.at("acl_fibres.stretch [-]", 2), tissue.at("acl_fibres.stretch [-]", 1) + 0.01);
  const auto force = [&](const std::string& probe, double time) {
    Vec3 f;
    for (int i = 0; i < 3; ++i) f[i] = tissue.at(probe + ".force." + "xyz"[i] + " [N]", time);
    return f;
  };
  EXPECT_GT(force("acl", 2).norm(), 70);
  EXPECT_LT(force("acl", 2).norm(), 150);
}

// Where nodes of both slide on bone, from 30 degrees to a turn outwards by 5 N m.
TEST(KneeLaxity, LigamentsOfTissueAreTurnedOutwardsInFlexion) {
  const ScenarioResults results =
      coarse_knee("laxity.toml", {"duration=5 s", "choice.acl=tissue", "choice.mcl=tissue",
                                  "curve.drawer.time=['0 s', '5 s']", "curve.drawer.value=[0, 0]",
                                  "curve.turn.time=['0 s', '4 s', '5 s']",
                                  "curve.turn.value=[0, 0, -5]", "curve.bend.time=['0 s', '5 s']",
                                  "curve.bend.value=[0, 0]", "load.1.time=['0 s', '1 s', '4 s']",
                                  "load.1.rotation=['0 0 0 deg', '0 0 0 deg', '-30 0 0 deg']"});
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const double outwards =
      results.at("knee.internal_rotation [deg]", 4) - results.at("knee.internal_rotation [deg]", 5);
  EXPECT_NEAR(outwards, 13, 6);  // of lines
  EXPECT_LT(results.count("newton_iterations"), 400);
}

#ifdef ARTICULAR_MESHER
TEST(KneeAxialLoad, OnARecordedKneeContactAndLigamentsBalanceTheLoad) {
  if (!has_recorded_anatomy()) GTEST_SKIP() << "ARTICULAR_DATA does not name the real anatomy";
  const ScenarioResults results =
      run_recorded_knee(shipped_scenario("knee/subject-axial-load.toml", {"duration=0.1 s"}));
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const double load = 100;  // [N]
  EXPECT_NEAR(results.column("femur.force.y [N]").back(), load, 1e-3 * load);
  EXPECT_LT(std::abs(results.column("femur.force.x [N]").back()), 1e-3 * load);
  EXPECT_LT(std::abs(results.column("femur.force.z [N]").back()), 1e-3 * load);
  const double contact =
      sum_of(results, {"cartilage_medial.force.y [N]", "cartilage_lateral.force.y [N]",
                       "above_meniscus_medial.force.y [N]", "above_meniscus_lateral.force.y [N]"});
  // Ligaments press the joint together too; both menisci carry.
  const double ligaments = sum_of(results, kRecordedLigaments);
  EXPECT_LT(contact, load + ligaments);
  EXPECT_GT(contact, load);
  for (const char* side : {"medial", "lateral"})
    EXPECT_GT(results.column(std::string("above_meniscus_") + side + ".force.y [N]").back(), 10);
  EXPECT_LT(results.summary().at("max_penetration_m").get<double>(), 0.02e-3);
}

// Ligaments were fitted on the shipped knee. With the same strains in extension the recorded one is
// about as easy there, easy at 30 degrees, and is drawn nearly as far as the knees of the fit. An
// anterolateral ligament, taut in extension, lets it turn inwards nearly as far as published;
// without it that is 26 degrees.
TEST(KneeLaxity, OnARecordedKneeTheFittedLigamentsHoldTrue) {
  if (!has_recorded_anatomy()) GTEST_SKIP() << "ARTICULAR_DATA does not name the real anatomy";
  const ScenarioResults results =
      run_recorded_knee(shipped_scenario("knee/subject-laxity.toml", {"duration=21 s"}));
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  std::vector<std::string> all_ligaments = kRecordedLigaments;
  all_ligaments.emplace_back("anterolateral.force [N]");
  const struct {
    double rest, flexion, ligaments, moment, drawer, spread;  // [s], [deg], [N], [N m], [mm]
  } angles[] = {{1, 0, 1.3 * kEasy, 2, 4.0, 1.4}, {16, 30, kEasy, 1, 6.0, 2.5}};
  for (const auto& [rest, flexion, ligaments, moment, drawer, spread] : angles) {
    EXPECT_NEAR(results.at("knee.flexion [deg]", rest), flexion, 1e-6) << rest;
    EXPECT_LT(sum_at(results, all_ligaments, rest), ligaments) << rest;
    EXPECT_LT(std::abs(results.at("femur.moment.x [N m]", rest)), moment) << rest;
    EXPECT_NEAR(results.at("knee.anterior [mm]", rest + 1) - results.at("knee.anterior [mm]", rest),
                drawer, 1.6 * spread)
        << rest;
  }
  EXPECT_NEAR(results.at("knee.internal_rotation [deg]", 21) -
                  results.at("knee.internal_rotation [deg]", 16),
              12.1, 2 * 4.0);  // 5 N m at 30 degrees
}
#endif

}  // namespace articular::knee_test
