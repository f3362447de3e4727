// Elements, laws, fibres and static analysis by way of the scenario file.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/scenarios/scenario_results.hpp"

namespace articular::tissue_scenes_test {

// Timoshenko's beam of verification/bending_beam.toml, 1.9495 mm. On a mesh with four cells across
// its depth, where plain elements are 16 % too stiff, smoothed ones are right within 2 %.
TEST(TissueScenes, SmoothedElementsBendRightOnACoarseMesh) {
  const auto deflection = [](const std::string& element) {
    const ScenarioResults results =
        run_scenario("verification/bending_beam.toml", {"analysis=static", "integrator.step=0.6 s",
                                                        "body.beam.geometry.box.cells=[24, 2, 4]",
                                                        "body.beam.material.element=" + element});
    EXPECT_EQ(results.summary().at("outcome"), "finished");
    EXPECT_GT(results.count("sundials_steps"), 0);
    return -results.last("end.position.z [mm]");
  };
  EXPECT_NEAR(deflection("smoothed"), 1.9495, 0.055 * 1.9495);
  EXPECT_LT(deflection("plain"), 0.9 * 1.9495);
}

// Static and dynamic analysis of the same contact end alike, but for how far its penalty lets the
// block sink in.
TEST(TissueScenes, ABlockOnABlockIsAtRestWhereStaticAnalysisPutsIt) {
  const ScenarioResults still = run_scenario("verification/block_on_block.toml",
                                             {"analysis=static", "integrator.step=0.25 s"});
  const ScenarioResults moving = run_scenario("verification/block_on_block.toml");
  const double weight = 1060 * 9.81 * 1e-6;
  EXPECT_NEAR(still.last("between.force.z [N]"), weight, 1e-3 * weight);
  EXPECT_NEAR(still.last("top.position.z [mm]"), moving.last("top.position.z [mm]"),
              moving.last("between.max_penetration [mm]"));
  EXPECT_GT(still.count("reported_pairs"), 0);
}

TEST(TissueScenes, ABlockOfMusclePullsWithItsActiveStress) {
  const ScenarioResults results = run_scenario("verification/muscle_block.toml");
  EXPECT_NEAR(results.last("pull.force.z [N]"), -0.6, 1e-5);
  EXPECT_GT(results.last("energy.muscle_work [J]"), 0);
}

// By the planar model, which the scenario's file has. Its fibres pull at aponeuroses: without these
// most of them have nothing to pull at.
TEST(TissueScenes, APennateMusclePullsAsThePlanarModelSays) {
  const auto pull_of = [](const ScenarioResults& results, double time) {
    return -results.at("insertion.force.x [N]", time);
  };
  const ScenarioResults results = run_scenario("verification/pennate_muscle.toml");
  EXPECT_NEAR(pull_of(results, 0.2), 77.14, 0.02 * 77.14);
  EXPECT_NEAR(pull_of(results, 1), 56.50, 0.025 * 56.50);
  EXPECT_NEAR(results.last("fibres.stretch [-]"), 0.8102, 0.01);
  EXPECT_LT(results.last("upper.largest_stretch [-]"), 1.002);
  const ScenarioResults without =
      run_scenario("verification/pennate_muscle.toml", {"choice.aponeuroses=off"});
  EXPECT_LT(pull_of(without, 0.2), 0.1 * 77.14);
}

// The same muscle as a line: sigma_max over its cross-section, without elements.
TEST(TissueScenes, AMuscleAsALinePullsAsMuchWithoutAnyUnknowns) {
  const ScenarioResults results =
      run_scenario("verification/muscle_block.toml", {"choice.muscle=line"});
  EXPECT_NEAR(results.last("pull.force.z [N]"), -0.6, 1e-6);
  EXPECT_EQ(results.summary().at("size").at("unknown_velocities"), 0);
  EXPECT_EQ(results.summary().at("evaluations").at("elastic_force"), 0);
  EXPECT_GT(results.summary().at("evaluations").at("line_muscle"), 0);
}

// Every scheme takes energy of a swing, none makes any; of first order five times what a second
// takes.
TEST(TissueScenes, ASwingingBeamLosesWhatItsSchemeTakes) {
  const auto lost = [](const std::string& scheme, const std::string& step) {
    const ScenarioResults results =
        run_scenario("verification/swinging_beam.toml",
                     {"duration=0.2 s", "integrator.scheme=" + scheme, "integrator.step=" + step});
    return results.last("energy.numerical_loss [J]") / results.column("energy.kinetic [J]")[0];
  };
  const double euler = lost("implicit-euler", "1 ms"), second = lost("tr-bdf2", "1 ms");
  EXPECT_LT(euler, 1);
  EXPECT_GT(euler, 5 * second);
  EXPECT_GT(second, 1.5 * lost("tr-bdf2", "0.25 ms"));
  EXPECT_GT(lost("dirk-3", "1 ms"), 0);
}

TEST(TissueScenes, ATumblingBodyKeepsItsEnergy) {
  const auto lost = [](const std::string& scheme, const std::string& step) {
    const ScenarioResults results =
        run_scenario("verification/tumbling_body.toml",
                     {"integrator.scheme=" + scheme, "integrator.step=" + step});
    return results.last("energy.numerical_loss [J]") / results.column("energy.kinetic [J]")[0];
  };
  for (const char* const scheme : {"tr-bdf2", "dirk-3"}) EXPECT_NEAR(lost(scheme, "2 ms"), 0, 1e-4);
  const double coarse = lost("implicit-euler", "1 ms"), fine = lost("implicit-euler", "0.5 ms");
  EXPECT_NEAR(coarse / fine, 2, 0.2);
}

// Nearly incompressible, plain tetrahedra lock.
TEST(TissueScenes, CooksMembraneLocksWithPlainElementsAlone) {
  const auto raised = [](const std::string& element, const std::string& cells) {
    const ScenarioResults results =
        run_scenario("verification/cook.toml", {"body.panel.material.element=" + element,
                                                "body.panel.geometry.hexahedron.cells=" + cells});
    return results.last("corner.position.y [mm]") - 60;
  };
  const double fine = raised("smoothed", "[12, 12, 3]");
  EXPECT_NEAR(raised("smoothed", "[8, 8, 2]"), fine, 0.06 * fine);
  EXPECT_LT(raised("plain", "[8, 8, 2]"), 0.88 * fine);
}

}  // namespace articular::tissue_scenes_test
