// What can be made finer in a scenario, and from where a search begins.
#include "tools/target_error/finer_runs.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::tools::finer_runs_test {

using Words = std::vector<std::string>;

std::string scene(const std::string& settings, const std::string& cells) {
  return "duration = '1 s'\n" + settings +
         "[[body]]\nname = 'block'\nkind = 'tissue'\ngeometry = { box = { size = '6 6 6 mm', cells "
         "= " +
         cells +
         " } }\ndensity = '1 g/cm^3'\nmaterial = { law = 'linear', young_modulus = '1 kPa', "
         "poisson_ratio = 0, element = 'plain' }\n";
}

sim::Scenario scenario_of(const TemporaryFolder& folder, const std::string& settings,
                          const std::string& cells = "[6, 6, 6]") {
  return sim::read_scenario(folder.file("scene.toml", scene(settings, cells)));
}

long cells_across(int n, double factor) { return std::lround(n / factor); }

TEST(MeshLevels, BeginCoarserThanTheSceneButNotWithFewerThanThreeCells) {
  for (const auto& [n, base, coarser, coarsest] :
       {std::array{12, 8, 5, 3}, std::array{8, 5, 3, 2}, std::array{4, 3, 2, 1},
        std::array{3, 3, 2, 1}, std::array{2, 3, 2, 1}}) {
    const MeshLevels levels = mesh_levels({n, n, n});
    EXPECT_EQ(cells_across(n, levels.base), base) << n;
    EXPECT_EQ(cells_across(n, levels.coarser), coarser) << n;
    EXPECT_EQ(cells_across(n, levels.coarsest), coarsest) << n;
    ASSERT_FALSE(levels.finer.empty());
    EXPECT_LT(levels.finer.front(), levels.base);
    EXPECT_GE(levels.finer.back(), 1.0 / 6 - 1e-9);
  }
}

TEST(MeshLevels, OfOneCellHaveNoCoarsestOne) {
  const MeshLevels levels = mesh_levels({1, 1, 1});
  EXPECT_EQ(cells_across(1, levels.base), 2);
  EXPECT_EQ(cells_across(1, levels.coarser), 1);
  EXPECT_EQ(levels.coarsest, 0);
}

// 7 by 4: two cells of four would be three and a half of seven.
TEST(MeshLevels, LeaveCellsWholeInAllDirections) {
  const MeshLevels levels = mesh_levels({7, 4});
  for (const double factor : levels.finer)
    EXPECT_NEAR(std::round(7 / factor) * factor / 7, 1, 0.11) << factor;
}

TEST(StepLengths, DivideTheIntervalOfFramesAndBeginAtTwiceTheStep) {
  const TemporaryFolder folder;
  const std::vector<double> lengths = step_lengths(
      scenario_of(folder, "[integrator]\nstep = '2 ms'\n[output]\ninterval = '20 ms'\n"));
  EXPECT_DOUBLE_EQ(lengths.front(), 4e-3);
  EXPECT_LT(lengths.back(), 2e-3 / 25);
  for (const double length : lengths) EXPECT_NEAR(20e-3 / length, std::round(20e-3 / length), 1e-9);
}

TEST(StepLengths, OfStaticsAreHalves) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      step_lengths(scenario_of(folder, "analysis = 'static'\n[integrator]\nstep = '0.5 s'\n")),
      (std::vector<double>{0.5, 0.25, 0.125, 0.0625}));
}

TEST(RefinementBase, HasCoarserElementsAndStepsThanTheScene) {
  const TemporaryFolder folder;
  const sim::Scenario scenario = scenario_of(
      folder, "contact = false\n[integrator]\nstep = '2 ms'\n[output]\ninterval = '20 ms'\n");
  const RefinementBase base = refinement_base(scenario, {}, folder / "prepared", true);
  EXPECT_EQ(base.overrides,
            (Words{"body.\"block\".geometry.box.cells=[4, 4, 4]", "integrator.step=\"0.004 s\""}));
  ASSERT_EQ(base.kinds.size(), 3U);
  const Refinement& mesh = base.kinds[0];
  ASSERT_EQ(mesh.coarser.runs.size(), 2U);
  EXPECT_NEAR(mesh.coarser.runs[0].size, 2, 1e-12);
  EXPECT_NEAR(mesh.coarser.runs[1].size, 4, 1e-12);
  ASSERT_GT(mesh.sizes.size(), 3U);
  EXPECT_NEAR(mesh.sizes[2], 4.0 / 6, 1e-12);
  EXPECT_EQ(mesh.settings(mesh.sizes[2]), Words{"body.\"block\".geometry.box.cells=[6, 6, 6]"});
  EXPECT_EQ(base.kinds[1].coarser.runs.at(0).overrides[0], "integrator.step=\"0.008 s\"");
  EXPECT_EQ(base.kinds[1].settings(0.5), Words{"integrator.step=\"0.002 s\""});
  EXPECT_EQ(base.kinds[2].settings(0.1), Words{"integrator.element_tolerance=5e-05"});
}

TEST(RefinementBase, IsTheSceneAsWrittenWhereACoarserOneFails) {
  const TemporaryFolder folder;
  const sim::Scenario scenario = scenario_of(
      folder, "[integrator]\nstep = '2 ms'\n[output]\ninterval = '20 ms'\n", "[12, 12, 12]");
  const RefinementBase base = refinement_base(scenario, {}, folder / "prepared", false);
  EXPECT_EQ(base.overrides, (Words{"body.\"block\".geometry.box.cells=[12, 12, 12]",
                                   "integrator.step=\"0.002 s\""}));
}

TEST(RefinementBase, SaysWhichMeshCantBeMadeAgain) {
  const TemporaryFolder folder;
  sim::write_mesh(folder / "scan.vtu", sim::box_mesh({{1e-3, 1e-3, 1e-3}, {2, 2, 2}, {0.1, 0, 0}}),
                  1e-3);
  const sim::Scenario scenario = sim::read_scenario(folder.file(
      "scene.toml",
      "duration = '1 s'\n[[body]]\nname = 'scan'\nkind = 'tissue'\nmesh = { file = 'scan.vtu' "
      "}\ndensity = '1 g/cm^3'\nmaterial = { law = 'linear', young_modulus = '1 kPa', "
      "poisson_ratio = 0, element = 'plain' }\n"));
  const RefinementBase base = refinement_base(scenario, {}, folder / "prepared", true);
  EXPECT_TRUE(base.kinds[0].coarser.runs.empty());
  EXPECT_NE(base.kinds[0].coarser.left_out.find("the mesh of `scan` can't be made"),
            std::string::npos)
      << base.kinds[0].coarser.left_out;
}

TEST(ContactRefinement, IsStifferBySizesBelowOne) {
  const TemporaryFolder folder;
  const sim::Scenario scenario = sim::read_scenario(folder.file(
      "scene.toml", scene("", "[6, 6, 6]") + "[[body]]\nname = 'floor'\nkind = "
                                             "'fixed'\ngeometry = { box = { size = '1 1 1 "
                                             "mm', cells = [1, 1, 1] } }\n"));
  const Refinement contact = contact_refinement(scenario, true);
  ASSERT_EQ(contact.coarser.runs.size(), 2U);
  EXPECT_EQ(contact.settings(1.0 / 3), Words{"contact_stiffness_factor=300"});
  RefinementBase base = refinement_base(scenario, {}, folder / "prepared", true);
  keep_depths(base.kinds[0], contact);
  EXPECT_EQ(base.kinds[0].coarser.runs.at(0).overrides.back(), "contact_stiffness_factor=200");
  EXPECT_TRUE(contact_refinement(scenario, false).coarser.runs.empty());
}

}  // namespace articular::tools::finer_runs_test
