// Legacy .vtk: what VTK writes is read, and whatever else is in a file is refused in one line.
#include <gtest/gtest.h>
#include <vtkPolyDataWriter.h>
#include <vtkUnstructuredGridWriter.h>

#include <random>

#include "sim/mesh/mesh_io.hpp"
#include "tests/sim/support/damaged_file.hpp"
#include "tests/sim/support/temporary_folder.hpp"
#include "tests/sim/support/vtk_sets.hpp"

namespace articular::sim::legacy_vtk_reader_test {

template <class Writer, class Set>
void write(const std::filesystem::path& file, Set* set, bool binary, int version) {
  vtkNew<Writer> writer;
  writer->SetInputData(set);
  writer->SetFileName(file.c_str());
  binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
  writer->SetFileVersion(version);
  ASSERT_EQ(writer->Write(), 1);
}

class Written : public ::testing::TestWithParam<std::tuple<bool, int, int>> {
 protected:
  std::filesystem::path grid() const {
    const auto [binary, version, type] = GetParam();
    write<vtkUnstructuredGridWriter>(folder_ / "m.vtk", some_grid(type).Get(), binary, version);
    return folder_ / "m.vtk";
  }
  std::filesystem::path surface() const {
    const auto [binary, version, type] = GetParam();
    write<vtkPolyDataWriter>(folder_ / "m.vtk", some_surface(type).Get(), binary, version);
    return folder_ / "m.vtk";
  }
  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(
    Vtk, Written,
    ::testing::Combine(::testing::Bool(),
                       ::testing::Values(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2,
                                         vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1),
                       ::testing::Values(VTK_FLOAT, VTK_DOUBLE)));

TEST_P(Written, AGridIsReadWithItsVectors) {
  const MeshData mesh = read_mesh(grid(), 1);
  ASSERT_EQ(mesh.X.cols(), 5);  // the last point is on a line alone
  EXPECT_EQ(Vec3(mesh.X.col(4)), Vec3(1, 1, 1.25));
  Tetrahedra tets(4, 2);
  tets << 0, 1, 1, 2, 2, 3, 3, 4;
  EXPECT_EQ(mesh.tets, tets);
  EXPECT_EQ(mesh.triangles, Eigen::Vector3i(0, 2, 1));
  ASSERT_EQ(mesh.cell_vectors.size(), 2U);
  for (const auto& [name, values] : mesh.cell_vectors) {
    EXPECT_TRUE(name == "fibre" || name == "direction") << name;
    ASSERT_EQ(values.cols(), 2);
    EXPECT_EQ(Vec3(values.col(0)), Vec3(0.5, -0.5, -1.5));
    EXPECT_EQ(Vec3(values.col(1)), Vec3(1.5, 0.5, -0.5));
  }
  ASSERT_EQ(mesh.sets.size(), 1U);
  EXPECT_EQ(mesh.sets[0].name, "rim");
  EXPECT_EQ(mesh.sets[0].nodes, (std::vector<int>{3, 4}));
}

TEST_P(Written, ASurfaceIsReadWithItsPolygonsAndStrips) {
  const MeshData mesh = read_mesh(surface(), 1);
  Triangles triangles(3, 4);
  triangles << 0, 0, 0, 1,  //
      1, 4, 1, 4,           //
      4, 2, 3, 3;
  EXPECT_EQ(mesh.X.cols(), 5);
  ASSERT_EQ(mesh.triangles.cols(), 4);
  std::vector<std::array<int, 3>> found;
  for (const auto& t : mesh.triangles.colwise()) found.push_back({t[0], t[1], t[2]});
  EXPECT_NE(std::find(found.begin(), found.end(), std::array{0, 1, 4}), found.end());
  EXPECT_NE(std::find(found.begin(), found.end(), std::array{0, 4, 2}), found.end());
  EXPECT_NE(std::find(found.begin(), found.end(), std::array{0, 1, 3}), found.end());
}

// Bytes changed, removed, doubled; numbers replaced by large ones.
TEST_P(Written, WhateverIsDamagedIsReadOrRefusedInOneLine) {
  const auto [binary, version, type] = GetParam();
  std::mt19937 random(static_cast<unsigned>(version * 4 + type * 2 + (binary ? 1 : 0)));
  for (const auto& file : {grid(), surface()}) {
    const std::string whole = content(file);
    int refused = 0;
    for (int trial = 0; trial < 100; ++trial) {
      const std::string message = refusal(folder_.file("damaged.vtk", damaged(whole, random)));
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      if (!message.empty()) ++refused;
    }
    EXPECT_GT(refused, 25);
  }
}

TEST(LegacyVtk, MoreThanTheFileHoldsIsRefusedBeforeMemoryIsTaken) {
  const TemporaryFolder folder;
  const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET ";
  const auto of = [&](const std::string& text) {
    return refusal(folder.file("m.vtk", head + text));
  };
  const std::string grid = "UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n";
  EXPECT_NE(of("POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n").find("ends before"),
            std::string::npos);
  EXPECT_NE(of("UNSTRUCTURED_GRID\nPOINTS 1e9 float\n0 0 0\n")
                .find("m.vtk:5: not readable as "
                      ".vtk: claims 1e9 points"),
            std::string::npos);
  EXPECT_NE(
      of(grid + "CELLS 1 5\n1000000 0 1 2 3\nCELL_TYPES 1\n10\n").find("claims 1000000 points"),
      std::string::npos);
  EXPECT_NE(of(grid + "CELLS 2 10\n4 0 1 2 3\n7 0 1 2 3\nCELL_TYPES 2\n10\n10\n").find("claims 7"),
            std::string::npos);
  EXPECT_NE(
      of(grid + "CELLS 2 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n").find("claims 2 cells, and holds 1"),
      std::string::npos);
  EXPECT_NE(of(grid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 2\n10\n10\n").find("types of 2 cells"),
            std::string::npos);
  EXPECT_NE(of(grid + "CELLS 1 5\n4 0 1 2 9\nCELL_TYPES 1\n10\n").find("refers to point 9"),
            std::string::npos);
  EXPECT_EQ(of(grid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"), "");
}

// What lies behind a link may be nobody's business.
TEST(LegacyVtk, AFileThatIsNoneIsNotQuoted) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal(folder.file("m.vtk", "root:secret:0:0\n")).find("secret"), std::string::npos);
}

}  // namespace articular::sim::legacy_vtk_reader_test
