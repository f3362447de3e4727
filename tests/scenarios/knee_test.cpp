// The knees of scenarios/knee/, with coarse elements and part of the load.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/build/build_model.hpp"
#include "sim/run/run.hpp"
#include "tests/scenarios/scenario_results.hpp"
#include "tests/tools/support/program.hpp"
#include "tools/anatomy/anatomy.hpp"
#include "tools/anatomy/anatomy_knee.hpp"

namespace articular::knee_test {

/// A scenario of scenarios/knee/ with elements of 4 mm.
ScenarioResults coarse_knee(const std::string& file, const std::vector<std::string>& overrides) {
  const TemporaryFolder folder;
  anatomy::write_anatomy(anatomy::knee_anatomy({4, 2}), folder.path() / "anatomy");
  sim::Scenario scenario = shipped_scenario("knee/" + file, overrides);
  for (sim::Body& body : scenario.bodies) {
    auto& mesh = std::get<sim::MeshFile>(body.geometry);
    mesh.path = folder.path() / "anatomy" / mesh.path.filename();
    for (sim::MeshFile& file : body.contact_meshes)
      file.path = folder.path() / "anatomy" / file.path.filename();
  }
  return run_scenario(scenario);
}

const std::vector<std::string> kLigaments{
    "acl_anterior.force [N]",  "acl_posterior.force [N]",    "pcl_anterior.force [N]",
    "pcl_posterior.force [N]", "lcl_anterior.force [N]",     "lcl_superior.force [N]",
    "lcl_posterior.force [N]", "mcl_anterior.force [N]",     "mcl_intermediate.force [N]",
    "mcl_posterior.force [N]", "capsule_anterior.force [N]", "capsule_posterior.force [N]"};

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

TEST(KneeAxialLoad, ContactAndLigamentsBalanceTheLoad) {
  const double load = 200;  // [N]
  const ScenarioResults results = loaded_knee(0.2);
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
  // All of it gets to the tibia, by its cartilage and the menisci's horns.
  const double tibia = sum_of(
      results, {"cartilage_of_tibia_medial.force.z [N]", "cartilage_of_tibia_lateral.force.z [N]",
                "horns_medial.force.z [N]", "horns_lateral.force.z [N]"});
  EXPECT_NEAR(contact, -tibia, 1e-3 * load);
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
  const ScenarioResults results = coarse_knee("flexion.toml", {"duration=0.22 s"});
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
}

/// The overrides in the lines of a file, as of `--set @FILE`.
std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::istringstream text(content(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);)
    if (line[0] != '#') lines.push_back(line);
  return lines;
}

// With the ligaments that `articular fit` found, passive flexion is easy and the drawer is within
// what was measured on 12 knees (physiology and sources: scenarios/SOURCES.md).
TEST(KneeLaxity, WithFittedLigamentsTheKneeBendsEasilyAndItsDrawerIsAsMeasured) {
  const ScenarioResults results = coarse_knee(
      "laxity.toml", lines_of(ARTICULAR_SOURCE_DIR "/scenarios/knee/laxity-fitted.txt"));
  const struct {
    double neutral, drawn, drawer, spread;  // [s], [s], [mm]
  } angles[] = {{1, 2, 4.0, 1.4}, {8, 9, 6.0, 2.5}, {27, 28, 4.7, 2.4}, {34, 35, 3.8, 2.5}};
  for (const auto& [neutral, drawn, drawer, spread] : angles) {
    double together = 0;
    for (const std::string& ligament : kLigaments) together += results.at(ligament, neutral);
    EXPECT_LT(together, 120) << neutral;
    EXPECT_LT(std::abs(results.at("femur.moment.x [N m]", neutral)), 1) << neutral;
    const double forwards =
        results.at("knee.anterior [mm]", drawn) - results.at("knee.anterior [mm]", neutral);
    EXPECT_NEAR(forwards, drawer, 1.2 * spread) << neutral;
  }
  EXPECT_EQ(results.count("rejected_motion"), 0);
}

#ifdef ARTICULAR_MESHER
TEST(KneeAxialLoad, OnARecordedKneeContactAndLigamentsBalanceTheLoad) {
  if (std::getenv("ARTICULAR_DATA") == nullptr)
    GTEST_SKIP() << "ARTICULAR_DATA does not name the folder with the real anatomy";
  const TemporaryFolder folder;
  const ProgramResult made =
      run_shell(folder, "out=$PWD; SIZE='4 mm' ARTICULAR=\"$articular\" '" ARTICULAR_SOURCE_DIR
                        "/tools/figures/subject-knee' \"$out/meshes\"");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  std::vector<std::string> settings = {"duration=0.1 s"};
  for (const auto& [body, mesh] :
       {std::pair("femoral_cartilage", "femcart"),
        std::pair("tibial_cartilage_medial", "tibcart_1"),
        std::pair("tibial_cartilage_lateral", "tibcart_2"),
        std::pair("meniscus_medial", "meniscus_1"), std::pair("meniscus_lateral", "meniscus_2")})
    settings.push_back(
        fmt::format("body.{}.mesh.file={}/meshes/{}.vtu", body, folder.path().string(), mesh));
  const ScenarioResults results = run_scenario("knee/subject-axial-load.toml", settings);
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const double load = 100;  // [N]
  EXPECT_NEAR(results.column("femur.force.y [N]").back(), load, 1e-3 * load);
  EXPECT_LT(std::abs(results.column("femur.force.x [N]").back()), 1e-3 * load);
  EXPECT_LT(std::abs(results.column("femur.force.z [N]").back()), 1e-3 * load);
  const double contact =
      sum_of(results, {"cartilage_medial.force.y [N]", "cartilage_lateral.force.y [N]",
                       "above_meniscus_medial.force.y [N]", "above_meniscus_lateral.force.y [N]"});
  // Ligaments press the joint together too; both menisci carry.
  const double ligaments = sum_of(
      results, {"acl_anterior.force [N]", "acl_posterior.force [N]", "pcl_anterior.force [N]",
                "pcl_posterior.force [N]", "lcl_anterior.force [N]", "lcl_superior.force [N]",
                "lcl_posterior.force [N]", "mcl_anterior.force [N]", "mcl_intermediate.force [N]",
                "mcl_posterior.force [N]"});
  EXPECT_LT(contact, load + ligaments);
  EXPECT_GT(contact, load);
  for (const char* side : {"medial", "lateral"})
    EXPECT_GT(results.column(std::string("above_meniscus_") + side + ".force.y [N]").back(), 10);
  EXPECT_LT(results.summary().at("max_penetration_m").get<double>(), 0.02e-3);
}
#endif

}  // namespace articular::knee_test
