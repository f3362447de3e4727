// Which meshes of a scene get coarser, by how much, and which do not.
#include "tools/error_bars/coarser_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/sim/support/temporary_folder.hpp"
#include "tools/error_bars/made_by.hpp"
#include "tools/error_bars/resized_mesh.hpp"

namespace articular::tools::coarser_mesh_test {

using Words = std::vector<std::string>;

const std::string kHead = "duration = '1 s'\nanalysis = 'static'\n";

std::string tissue(const std::string& name, const std::string& shape) {
  return "[[body]]\nname = '" + name + "'\nkind = 'tissue'\n" + shape +
         "\ndensity = '1000 kg/m^3'\nmaterial = { law = 'linear', young_modulus = '1 kPa', "
         "poisson_ratio = 0, element = 'plain' }\n";
}

std::string box(const std::string& cells, const std::string& center = "0 0 0 mm") {
  return "geometry = { box = { size = '6 6 6 mm', cells = " + cells + ", center = '" + center +
         "' } }";
}

Direction meshes_of(const TemporaryFolder& folder, const std::string& scene, double ratio = 0) {
  const auto file = folder.file("scene.toml", kHead + scene);
  return coarser_meshes(sim::read_scenario(file), {}, folder / "prepared", true, ratio);
}

TEST(MeshCommand, KeepsAllButSizeAndPlace) {
  const auto command =
      mesh_command("articular mesh 'my scan.obj' --size \"2 mm\" --out=out/cartilage.vtu --split");
  ASSERT_TRUE(command);
  EXPECT_EQ(resized_arguments(*command, 1.5),
            (Words{"mesh", "my scan.obj", "--size", "3 mm", "--out",
                   "${ARTICULAR_PREPARED}/cartilage.vtu", "--split"}));
  const auto anatomy = mesh_command("build/release/bin/articular anatomy knee --out x --size=2.5");
  ASSERT_TRUE(anatomy);
  EXPECT_EQ(resized_arguments(*anatomy, 1.25),
            (Words{"anatomy", "knee", "--out", "${ARTICULAR_PREPARED}", "--size", "3.125"}));
}

// Only ours are run, and only those whose size is known.
TEST(MeshCommand, OthersAreNotTaken) {
  for (const char* const text :
       {"", "gmsh -3 --size 2 --out x", "articular run --size 2 --out x", "articular",
        "articular anatomy knee --out x", "articular anatomy knee --size 2", "rm -r articular",
        "articular anatomy knee --size two --out x", "articular anatomy knee --out x --size"})
    EXPECT_FALSE(mesh_command(text)) << text;
}

TEST(Coarsening, TakesFactorsThatLeaveCellsWhole) {
  for (const auto& counts : {std::vector<int>{6, 6, 6}, std::vector<int>{48, 4, 8},
                             std::vector<int>{16, 16, 8}, std::vector<int>{2, 20}}) {
    const auto [first, second] = coarsening_of(counts);
    EXPECT_GT(first, 1.3);
    EXPECT_GT(second / first, 1.19);
    EXPECT_LE(second, 4);
  }
  EXPECT_EQ(coarsening_of({16, 16, 8}), (std::pair<double, double>(4.0 / 3, 2)));
  EXPECT_EQ(coarsening_of({6, 6, 6}), (std::pair<double, double>(1.5, 2)));
  EXPECT_EQ(coarsening_of({9, 9}), (std::pair<double, double>(1.5, 2.25)));
}

// 12, 8 and 6 cells along each edge. Sizes are those of the elements.
TEST(CoarserMeshes, OfABoxHaveFewerCells) {
  const TemporaryFolder folder;
  const Direction mesh = meshes_of(folder, tissue("a b", box("[12, 12, 12]")));
  EXPECT_EQ(mesh.left_out, "");
  ASSERT_EQ(mesh.runs.size(), 2U);
  EXPECT_EQ(mesh.runs[0].overrides, Words{"body.\"a b\".geometry.box.cells=[8, 8, 8]"});
  EXPECT_NEAR(mesh.runs[0].size, 1.5, 1e-12);
  EXPECT_EQ(mesh.runs[1].overrides, Words{"body.\"a b\".geometry.box.cells=[6, 6, 6]"});
  EXPECT_NEAR(mesh.runs[1].size, 2, 1e-12);

  const Direction narrow = meshes_of(folder, tissue("a b", box("[12, 12, 12]")), 1.2);
  ASSERT_EQ(narrow.runs.size(), 2U);
  EXPECT_EQ(narrow.runs[0].name, "mesh 1.2 times");
  EXPECT_NEAR(narrow.runs[0].size, 1.2, 1e-12);
  EXPECT_NEAR(narrow.runs[1].size, 1.5, 1e-12);  // 8 cells for 8.3
}

// By the elements that there are: a factor of 4/3 leaves 4 of 5 cells. The ball has no say beside
// tissue.
TEST(CoarserMeshes, SizesAreThoseThatRoundingLeaves) {
  const TemporaryFolder folder;
  const Direction mesh = meshes_of(
      folder, tissue("block", box("[5, 5, 5]")) +
                  "[[body]]\nname = 'ball'\nkind = 'fixed'\ngeometry = { sphere = { radius = '8 "
                  "mm', element_size = '1 mm', center = '0 0 30 mm' } }\n");
  ASSERT_FALSE(mesh.runs.empty());
  EXPECT_EQ(mesh.runs[0].name, "mesh 1.33 times");
  EXPECT_NEAR(mesh.runs[0].size, 5.0 / 4, 1e-12);
  EXPECT_EQ(mesh.runs[0].overrides.size(), 2U);
  EXPECT_EQ(mesh.runs[0].overrides[1].rfind("body.\"ball\".geometry.sphere.element_size=\"0.00", 0),
            0U);
}

TEST(CoarserMeshes, OfOneCellThereAreNone) {
  const TemporaryFolder folder;
  const Direction mesh = meshes_of(folder, tissue("block", box("[1, 1, 1]")));
  EXPECT_TRUE(mesh.runs.empty());
  EXPECT_EQ(mesh.left_out, "there are no fewer cells to take");
  EXPECT_TRUE(mesh.is_needed);
}

// A mesh file of unknown origin is named, and its error is not in the bar; the block's is.
TEST(CoarserMeshes, AFileOfUnknownOriginIsSaidToBeLeftOut) {
  const TemporaryFolder folder;
  sim::write_mesh(folder / "scan.vtu", sim::box_mesh({{1e-3, 1e-3, 1e-3}, {2, 2, 2}, {0.1, 0, 0}}),
                  1e-3);
  const std::string scan = tissue("scan", "mesh = { file = 'scan.vtu' }");
  const Direction alone = meshes_of(folder, scan);
  EXPECT_TRUE(alone.runs.empty());
  EXPECT_TRUE(alone.is_needed);
  const std::string plate = "[[body]]\nname = 'plate'\nkind = 'fixed'\n" + box("[4, 4, 4]") + "\n";
  EXPECT_TRUE(meshes_of(folder, scan + plate).runs.empty());  // a coarser plate says nothing of it
  EXPECT_EQ(alone.left_out.rfind("`scan` can't be made coarser", 0), 0U) << alone.left_out;
  const Direction both = meshes_of(folder, scan + tissue("block", box("[4, 4, 4]")));
  EXPECT_FALSE(both.runs.empty());
  EXPECT_EQ(both.left_out, alone.left_out);
}

// What is only looked at has no error.
TEST(CoarserMeshes, ABoneThatTouchesNothingIsNotMissed) {
  const TemporaryFolder folder;
  sim::write_mesh(folder / "bone.vtu", sim::box_mesh({{1e-3, 1e-3, 1e-3}, {2, 2, 2}, {0.1, 0, 0}}),
                  1e-3);
  const std::string bone =
      "[[body]]\nname = 'bone'\nkind = 'fixed'\nmesh = { file = 'bone.vtu' }\ncollides = ";
  EXPECT_EQ(meshes_of(folder, bone + "false\n").left_out, "");
  EXPECT_EQ(meshes_of(folder, bone + "true\n").left_out.rfind("surface of `bone` can't", 0), 0U);
}

}  // namespace articular::tools::coarser_mesh_test
