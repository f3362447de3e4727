// Elements and nodes that stand in a mesh file twice, and positions that are no lengths.
#include "sim/mesh/mesh_defects.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::mesh_defects_test {

constexpr const char* kNodes =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 1\n";

std::filesystem::path deck(const TemporaryFolder& folder, const std::string& text) {
  std::filesystem::path file = folder / "part.inp";
  std::ofstream(file) << text;
  return file;
}

std::string error_of(const std::filesystem::path& file) {
  try {
    read_mesh(file, 1);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MeshDefects, AnElementListedTwiceIsNamedWithBothNumbers) {
  const TemporaryFolder folder;
  const std::string elements = std::string(kNodes) + "*ELEMENT, TYPE=C3D4\n";
  for (const char* again : {"1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n3, 2, 1, 4, 3\n",
                            "1, 1, 2, 3, 4\n7, 2, 3, 4, 5\n8, 1, 2, 3, 4\n"}) {
    const std::string message = error_of(deck(folder, elements + again));
    EXPECT_NE(message.find("part.inp: tetrahedra 0 and 2 "), std::string::npos) << message;
  }
  EXPECT_EQ(error_of(deck(folder, elements + "1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n")), "");
}

TEST(MeshDefects, ANodeTwiceInAnElementIsNamed) {
  const TemporaryFolder folder;
  const std::string message = error_of(deck(
      folder,
      std::string(kNodes) + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 2, 3, 5, 3\n3, 2, 3, 4, 5\n"));
  EXPECT_NE(message.find("tetrahedron 1 (counted from 0) has one node twice"), std::string::npos)
      << message;
}

TEST(MeshDefects, APositionThatIsNoLengthIsNamedWithItsPlace) {
  const TemporaryFolder folder;
  const std::string message =
      error_of(deck(folder,
                    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1e30, 0\n4, 0, 0, 1\n"
                    "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n"));
  EXPECT_NE(message.find("point 2 (counted from 0) lies at (0 1e+30 0) m"), std::string::npos)
      << message;
}

TEST(MeshDefects, TheBodyOfADamagedMeshIsNamed) {
  const TemporaryFolder folder;
  Scenario s = contact_scene(1e-3);
  s.bodies = {box_body("meniscus", Body::Kind::Tissue, Vec3::Ones())};
  MeshFile file;
  file.path =
      deck(folder, std::string(kNodes) + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 1, 2, 3, 4\n");
  s.bodies[0].geometry = file;
  try {
    (void)build_model(s);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("`meniscus`"), std::string::npos) << error.what();
  }
}

/// Two halves of a block, which share no node.
TEST(MeshDefects, TissueThatFallsApartAlongASeamIsWarnedOf) {
  const TemporaryFolder folder;
  const auto half = [](double x) {
    return box_mesh({Vec3(0.01, 0.01, 0.01), {1, 1, 1}, Vec3(x, 0, 0)});
  };
  MeshData both = half(0);
  const MeshData right = half(0.01);
  const auto nodes = static_cast<int>(both.X.cols());
  both.X.conservativeResize(3, 2 * nodes);
  both.X.rightCols(nodes) = right.X;
  const Eigen::Index elements = both.tets.cols();
  both.tets.conservativeResize(4, 2 * elements);
  both.tets.rightCols(elements) = right.tets.array() + nodes;
  both.triangles.resize(3, 0);
  EXPECT_EQ(coincident_nodes(right.X).count, 0);
  const CoincidentNodes found = coincident_nodes(both.X);
  EXPECT_EQ(found.count, 4);
  EXPECT_NEAR(found.place.x(), 0.005, 1e-15);

  Scenario s = contact_scene(1e-3);
  s.bodies = {mesh_body("disc", Body::Kind::Tissue, both, folder)};
  const Model model = build_model(s);
  ASSERT_EQ(model.warnings.size(), 1U);
  EXPECT_NE(model.warnings[0].find("4 of 16 nodes of `disc` lie where another"), std::string::npos)
      << model.warnings[0];
}

}  // namespace articular::sim::mesh_defects_test
