// Formats with named sets. The files in tests/fuzz/seeds/files were written by Gmsh 4.8.4, TetGen
// 1.5 and by hand: a box of 1 x 1 x 2, or a cube with a roof.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "collision/mesh/surface.hpp"
#include "sim/base/error.hpp"
#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/mesh_sets.hpp"
#include "sim/mesh/solid_cells.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::set_formats_test {

using Eigen::Vector3d;

const std::filesystem::path kSeeds =
    std::filesystem::path(ARTICULAR_SOURCE_DIR) / "tests/fuzz/seeds/files";

double volume(const MeshData& mesh) {
  double sum = 0;
  for (const auto& t : mesh.tets.colwise()) {
    Eigen::Matrix3d edges;
    for (int a = 0; a < 3; ++a) edges.col(a) = mesh.X.col(t(a + 1)) - mesh.X.col(t(0));
    EXPECT_GT(edges.determinant(), 0);
    sum += edges.determinant() / 6;
  }
  return sum;
}

/// All faces inside are shared by two tetrahedra: the surface has the area of the solid alone.
double surface_area(const MeshData& mesh) {
  double sum = 0;
  const collision::Surface surface =
      collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols()));
  for (const auto& f : surface.faces.colwise())
    sum += 0.5 * Vector3d(mesh.X.col(f(1)) - mesh.X.col(f(0)))
                     .cross(Vector3d(mesh.X.col(f(2)) - mesh.X.col(f(0))))
                     .norm();
  return sum;
}

const MeshSet& set_of(const MeshData& mesh, const std::string& name) {
  const MeshSet* const set = find_set(mesh, name);
  if (set == nullptr) throw std::runtime_error("no set " + name + known_sets(mesh));
  return *set;
}

/// The box of 1 x 1 x 2 with the set of its upper face.
void expect_box(const MeshData& mesh, const std::string& top, const std::string& all) {
  EXPECT_EQ(mesh.X.cols(), 14);
  EXPECT_EQ(mesh.tets.cols(), 24);
  EXPECT_NEAR(volume(mesh), 2, 1e-12);
  EXPECT_NEAR(surface_area(mesh), 10, 1e-12);
  EXPECT_EQ(set_of(mesh, all).tets.size(), 24U);
  const MeshSet& upper = set_of(mesh, top);
  EXPECT_EQ(upper.faces.size(), 4U);
  EXPECT_EQ(upper.nodes.size(), 5U);
  for (const int a : upper.nodes) EXPECT_EQ(mesh.X(2, a), 2);
}

class GmshBox : public testing::TestWithParam<const char*> {};

TEST_P(GmshBox, IsReadWithItsPhysicalGroups) {
  const MeshData mesh = read_mesh(kSeeds / GetParam(), 1);
  expect_box(mesh, "top", "disc");
  for (const int a : set_of(mesh, "surface 9").nodes) EXPECT_EQ(mesh.X(2, a), 0);
}

INSTANTIATE_TEST_SUITE_P(SetFormats, GmshBox,
                         testing::Values("gmsh-22.msh", "gmsh-22-binary.msh", "gmsh-41.msh",
                                         "gmsh-41-binary.msh"));

TEST(SetFormats, MeditReferencesAreSets) {
  expect_box(read_mesh(kSeeds / "medit.mesh", 1), "surface 26", "volume 1");
}

TEST(SetFormats, NastranPropertiesAreSets) {
  const MeshData mesh = read_mesh(kSeeds / "nastran.bdf", 1);
  EXPECT_NEAR(volume(mesh), 2, 1e-6);  // eight characters a number
  EXPECT_FALSE(mesh.sets.empty());
}

TEST(SetFormats, TetGenRegionsAreSetsWhicheverFileIsNamed) {
  for (const char* const name : {"tetgen.ele", "tetgen.node"}) {
    const MeshData mesh = read_mesh(kSeeds / name, 1);
    EXPECT_NEAR(volume(mesh), 2, 1e-12);
    EXPECT_EQ(set_of(mesh, "volume 1").tets.size(), 24U);
    EXPECT_EQ(set_of(mesh, "surface 1").faces.size(), 24U);
  }
}

TEST(SetFormats, AFebioModelHasPartsSetsAndFibres) {
  const MeshData mesh = read_mesh(kSeeds / "model.feb", 1);
  EXPECT_EQ(mesh.X.cols(), 9);
  EXPECT_NEAR(volume(mesh), 1 + 1.0 / 3, 1e-12);
  EXPECT_EQ(set_of(mesh, "cube").tets.size(), 6U);
  EXPECT_EQ(set_of(mesh, "roof").tets.size(), 2U);
  EXPECT_EQ(set_of(mesh, "both").tets.size(), 8U);
  EXPECT_EQ(set_of(mesh, "bottom").nodes, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(set_of(mesh, "ridge").nodes, std::vector<int>{8});
  EXPECT_EQ(set_of(mesh, "front").faces.size(), 3U);
  ASSERT_EQ(mesh.cell_vectors.size(), 1U);
  EXPECT_EQ(mesh.cell_vectors[0].second.col(0), Vector3d(0, 0, 1));
  EXPECT_EQ(mesh.cell_vectors[0].second.col(7), Vector3d(1, 0, 0));
}

// A hexahedron, a wedge on its side, a pyramid on top and a tetrahedron on that, whose
// quadrilaterals are numbered so that each cut is another.
TEST(SetFormats, SolidsOfAllShapesBecomeTetrahedraThatConform) {
  const TemporaryFolder folder;
  const auto file = folder.file(
      "m.inp",
      "*NODE\n10,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n50,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n9,2,0,0\n"
      "1,2,1,0\n11,0.5,0.5,2\n12,0.5,-1,1.5\n*ELEMENT,TYPE=C3D8R,ELSET=cube\n1,10,2,3,4,50,6,7,"
      "\n8\n"
      "*ELEMENT,TYPE=C3D6,ELSET=wedge\n2,2,6,9,3,7,1\n*ELEMENT,TYPE=C3D5,ELSET=roof\n"
      "3,50,6,7,8,11\n*ELEMENT,TYPE=C3D4,ELSET=tip\n4,50,12,6,11\n"
      "*ELSET,ELSET=upper\nroof,tip\n*ELSET,ELSET=Two,GENERATE\n1,2\n"
      "*SURFACE,NAME=floor\ncube,S1\n*NSET,NSET=ends\n10,\n11,12\n*NSET,NSET=more\nENDS,2\n");
  const MeshData mesh = read_mesh(file, 1);
  EXPECT_EQ(mesh.tets.cols(), 6 + 3 + 2 + 1);
  const double expected = 1 + 0.5 + 1.0 / 3;
  EXPECT_NEAR(volume(mesh) - expected, 1.25 / 6, 1e-12);
  const MeshData cube = read_mesh(file, 1, {"cube", "wedge", "roof"});
  EXPECT_NEAR(volume(cube), expected, 1e-12);
  const double roof = 4 * 0.5 * std::sqrt(1.25), slope = std::sqrt(2.0);
  EXPECT_NEAR(surface_area(cube), 4 + (2 * 0.5 + 1 + slope) + roof, 1e-12);
  EXPECT_EQ(set_of(mesh, "upper").tets.size(), 3U);
  EXPECT_EQ(set_of(mesh, "Two").tets.size(), 9U);
  EXPECT_EQ(set_of(mesh, "floor").faces.size(), 2U);
  EXPECT_EQ(set_of(mesh, "ends").nodes.size(), 3U);
  EXPECT_EQ(set_of(mesh, "more").nodes.size(), 4U);
}

// Whatever their numbers: 8! orders are too many, so some at random.
TEST(SetFormats, AHexahedronAndItsNeighbourAreCutAlikeAtTheirFace) {
  std::vector<int> numbers(12);
  for (int k = 0; k < 12; ++k) numbers[static_cast<std::size_t>(k)] = k;
  std::mt19937 random(5);
  std::set<std::size_t> cuts;
  for (int trial = 0; trial < 200; ++trial) {
    std::shuffle(numbers.begin(), numbers.end(), random);
    const auto n = [&](int k) { return numbers[static_cast<std::size_t>(k)]; };
    std::map<std::set<int>, int> faces;
    std::size_t count = 0;
    for (const std::vector<int>& hexahedron :
         {std::vector{n(0), n(1), n(2), n(3), n(4), n(5), n(6), n(7)},
          std::vector{n(4), n(5), n(6), n(7), n(8), n(9), n(10), n(11)}})
      for (const auto& tet : tetrahedra_of(CellShape::Hexahedron, hexahedron)) {
        ++count;
        for (std::size_t a = 0; a < 4; ++a)
          ++faces[{tet[(a + 1) % 4], tet[(a + 2) % 4], tet[(a + 3) % 4]}];
      }
    EXPECT_EQ(count, 12U);
    std::size_t outside = 0;
    for (const auto& [face, uses] : faces) outside += uses == 1 ? 1U : 0U;
    EXPECT_EQ(outside, 20U);  // ten quadrilaterals
    cuts.insert(faces.count({n(4), n(5), n(6)}));
  }
  EXPECT_EQ(cuts.size(), 2U);  // both diagonals occurred
}

TEST(SetFormats, APartIsTheOnlyOneThatIsReadAndSetsFollow) {
  const MeshData roof = read_mesh(kSeeds / "model.feb", 1, {"roof"});
  EXPECT_EQ(roof.X.cols(), 5);
  EXPECT_NEAR(volume(roof), 1.0 / 3, 1e-12);
  EXPECT_EQ(set_of(roof, "cube").nodes.size(), 4U);  // those that both have
  EXPECT_EQ(set_of(roof, "cube").tets.size(), 0U);
  EXPECT_EQ(set_of(roof, "both").tets, (std::vector<int>{0, 1}));
  EXPECT_EQ(set_of(roof, "bottom").nodes.size(), 0U);
  EXPECT_EQ(roof.cell_vectors[0].second.cols(), 2);
  const MeshData front = read_mesh(kSeeds / "model.feb", 1, {"front"});
  EXPECT_EQ(front.triangles.cols(), 3);
  EXPECT_EQ(front.tets.cols(), 0);
}

TEST(SetFormats, AMissingPartIsRefusedWithThoseThatAreThere) {
  try {
    read_mesh(kSeeds / "gmsh-41.msh", 1, {"disk"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("has no set `disk`; it has `surface 9`, `top`, `disc`"),
        std::string::npos)
        << error.what();
  }
}

// Small, large and free fields, numbers without an E, ranges of constraints.
TEST(SetFormats, NastranFieldsOfAllWidthsAreRead) {
  const TemporaryFolder folder;
  const auto file =
      folder.file("m.bdf",
                  "$ a comment\nSOL 101\nCEND\nBEGIN BULK\n"
                  "GRID    1               0.0     0.0     0.0\n"
                  "GRID*   2                               1.0             0.0             +A\n"
                  "*A      0.0\n"
                  "grid,3,,0.,1.+0,\nGRID,40,0,0,0,1.5-1\n"
                  "CTETRA,1,7,1,2,3,40\nCTRIA3  2       8       1       2       3\n"
                  "SPC1,5,123,1,THRU,3\nSPC,6,40,123,0.0\nENDDATA\nnonsense\n");
  const MeshData mesh = read_mesh(file, 1);
  EXPECT_EQ(mesh.tets, Eigen::Vector4i(0, 1, 2, 3));
  EXPECT_EQ(mesh.X.col(1), Vector3d(1, 0, 0));
  EXPECT_EQ(mesh.X.col(2), Vector3d(0, 1, 0));
  EXPECT_EQ(mesh.X(2, 3), 0.15);
  EXPECT_EQ(set_of(mesh, "volume 7").tets.size(), 1U);
  EXPECT_EQ(set_of(mesh, "surface 8").faces.size(), 1U);
  EXPECT_EQ(set_of(mesh, "spc 5").nodes.size(), 3U);
  EXPECT_EQ(set_of(mesh, "spc 6").nodes, std::vector<int>{3});
}

}  // namespace articular::sim::set_formats_test
