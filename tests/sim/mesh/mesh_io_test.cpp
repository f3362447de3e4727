#include "sim/mesh/mesh_io.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

#include "sim/base/error.hpp"
#include "tests/sim/support/damaged_file.hpp"
#include "tests/sim/support/readable_line.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::mesh_io_test {

constexpr double kMillimetre = 1e-3;  // [m]

constexpr const char* kEndings[] = {".vtu", ".vtp", ".vtk", ".stl", ".obj",  ".ply",
                                    ".inp", ".msh", ".feb", ".bdf", ".mesh", ".ele"};

/// Two tetrahedra on a common face, at positions that no short decimal number meets.
MeshData two_tetrahedra() {
  MeshData mesh;
  mesh.X.resize(3, 5);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> position(-0.1, 0.1);
  for (double& x : mesh.X.reshaped()) x = position(random);
  mesh.tets.resize(4, 2);
  mesh.tets << 0, 1, 1, 2, 2, 3, 3, 4;
  mesh.triangles.resize(3, 0);
  return mesh;
}

double volume(const MeshData& mesh) {
  double sum = 0;
  for (const auto& t : mesh.tets.colwise()) {
    Mat3 edges;
    for (int a = 0; a < 3; ++a) edges.col(a) = mesh.X.col(t(a + 1)) - mesh.X.col(t(0));
    sum += edges.determinant() / 6;
  }
  for (const auto& t : mesh.triangles.colwise())
    sum += mesh.X.col(t(0)).cross(mesh.X.col(t(1))).dot(mesh.X.col(t(2))) / 6;
  return sum;
}

/// The message of the InputError, checked to be one line and not to be printed as well.
std::string error_of(const std::filesystem::path& file) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  std::string message = "no error";
  try {
    read_mesh(file, 1);
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return message;
}

TEST(MeshIo, TetrahedraWrittenAndReadAreTheSameToTheLastBit) {
  const TemporaryFolder folder;
  const MeshData mesh = two_tetrahedra();
  write_mesh(folder / "m.vtu", mesh, 1);
  const MeshData read = read_mesh(folder / "m.vtu", 1);
  EXPECT_EQ(read.X, mesh.X);
  EXPECT_EQ(read.tets, mesh.tets);
  EXPECT_EQ(read.triangles.cols(), 0);
}

TEST(MeshIo, SurfaceWrittenAndReadIsTheSameToTheLastBit) {
  const TemporaryFolder folder;
  MeshData mesh = two_tetrahedra();
  mesh.triangles = mesh.tets.topRows(3);
  mesh.triangles(2, 1) = 4;
  mesh.tets.resize(4, 0);
  mesh.X.col(3) = mesh.X.col(4);
  mesh.X.conservativeResize(3, 4);
  mesh.triangles(2, 1) = 3;
  write_mesh(folder / "m.vtp", mesh, 1);
  const MeshData read = read_mesh(folder / "m.vtp", 1);
  EXPECT_EQ(read.X, mesh.X);
  EXPECT_EQ(read.triangles, mesh.triangles);
  EXPECT_EQ(read.tets.cols(), 0);
}

TEST(MeshIo, TetrahedraAndTrianglesOfOneMeshStayTogether) {
  const TemporaryFolder folder;
  MeshData mesh = two_tetrahedra();
  mesh.triangles.resize(3, 1);
  mesh.triangles << 0, 2, 1;
  write_mesh(folder / "m.vtu", mesh, 1);
  const MeshData read = read_mesh(folder / "m.vtu", 1);
  EXPECT_EQ(read.tets, mesh.tets);
  EXPECT_EQ(read.triangles, mesh.triangles);
}

TEST(MeshIo, UnitScalesPositionsBothWays) {
  const TemporaryFolder folder;
  const MeshData mesh = two_tetrahedra();
  write_mesh(folder / "m.vtu", mesh, kMillimetre);
  const MeshData in_file = read_mesh(folder / "m.vtu", 1);
  EXPECT_LT((in_file.X * kMillimetre - mesh.X).norm(), 1e-15 * mesh.X.norm());
  const MeshData read = read_mesh(folder / "m.vtu", kMillimetre);
  EXPECT_LT((read.X - mesh.X).norm(), 1e-15 * mesh.X.norm());
}

TEST(MeshIo, NodesThatNoCellUsesAreDroppedAndTheOthersKeepTheirOrder) {
  const TemporaryFolder folder;
  MeshData mesh = two_tetrahedra();
  mesh.tets.conservativeResize(Eigen::NoChange, 1);
  mesh.tets.array() += 1;  // node 0 is unused
  write_mesh(folder / "m.vtu", mesh, 1);
  const MeshData read = read_mesh(folder / "m.vtu", 1);
  EXPECT_EQ(read.X, mesh.X.rightCols(4));
  EXPECT_EQ(read.tets.col(0), Eigen::Vector4i(0, 1, 2, 3));
}

TEST(MeshIo, LegacyUnstructuredGridIsRead) {
  const TemporaryFolder folder;
  const auto file = folder.file("m.vtk",
                                "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                                "POINTS 5 double\n0 0 0 0.1234567890123456 0 0 0 1 0 0 0 1 9 9 9\n"
                                "CELLS 2 9\n4 0 1 2 3\n3 0 2 1\nCELL_TYPES 2\n10\n5\n");
  const MeshData mesh = read_mesh(file, 1);
  EXPECT_EQ(mesh.X.cols(), 4);
  EXPECT_EQ(mesh.X(0, 1), 0.1234567890123456);
  EXPECT_EQ(mesh.tets, Eigen::Vector4i(0, 1, 2, 3));
  EXPECT_EQ(mesh.triangles, Eigen::Vector3i(0, 2, 1));
}

TEST(MeshIo, PolygonsAndStripsBecomeTrianglesOfTheSameSide) {
  const TemporaryFolder folder;
  const std::string points =
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n"
      "0 0 0 1 0 0 1 1 0 0 1 0\n";
  const auto quad = folder.file("quad.vtk", points + "POLYGONS 1 5\n4 0 1 2 3\n");
  const auto strip = folder.file("strip.vtk", points + "TRIANGLE_STRIPS 1 5\n4 0 1 3 2\n");
  for (const auto& file : {quad, strip}) {
    const MeshData mesh = read_mesh(file, 1);
    ASSERT_EQ(mesh.triangles.cols(), 2);
    for (const auto& t : mesh.triangles.colwise()) {
      const Vec3 area_vector =
          0.5 * (mesh.X.col(t(1)) - mesh.X.col(t(0))).cross(mesh.X.col(t(2)) - mesh.X.col(t(0)));
      EXPECT_EQ(area_vector, Vec3(0, 0, 0.5)) << file;
    }
  }
}

TEST(MeshIo, CoincidentVerticesOfStlAreMergedInTextAndInBinary) {
  const TemporaryFolder folder;
  const std::vector<std::array<float, 9>> triangles = {{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                                       {1, 0, 0, 1, 1, 0, 0, 1, 0}};
  std::string text = "solid s\n", binary(80, ' ');
  const auto append = [&](const auto& value) {
    binary.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    append(std::array<float, 3>{0, 0, 1});
    append(triangle);
    append(std::uint16_t{0});
    text += "facet normal 0 0 1\nouter loop\n";
    for (std::size_t a = 0; a < 9; a += 3)
      text += "vertex " + std::to_string(triangle[a]) + " " + std::to_string(triangle[a + 1]) +
              " " + std::to_string(triangle[a + 2]) + "\n";
    text += "endloop\nendfacet\n";
  }
  for (const auto& file :
       {folder.file("text.stl", text + "endsolid s\n"), folder.file("binary.stl", binary)}) {
    const MeshData mesh = read_mesh(file, 1);
    EXPECT_EQ(mesh.X.cols(), 4) << file;
    EXPECT_EQ(mesh.triangles.cols(), 2) << file;
  }
}

TEST(MeshIo, PlyIsReadInTextAndInBinaryOfEitherByteOrder) {
  const TemporaryFolder folder;
  const auto header = [](const std::string& layout) {
    return "ply\nformat " + layout +
           " 1.0\ncomment a square\nelement vertex 4\nproperty double x\nproperty double y\n"
           "property double z\nproperty uchar red\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n";
  };
  const std::vector<std::array<double, 3>> points = {
      {0.1234567890123456, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  std::string little, big;
  const auto append = [&](auto value) {
    const std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    little += bytes;  // on the machines that this runs on
    big.append(bytes.rbegin(), bytes.rend());
  };
  for (const auto& point : points) {
    for (const double x : point) append(x);
    append(std::uint8_t{255});
  }
  append(std::uint8_t{4});
  for (const std::int32_t corner : {0, 1, 2, 3}) append(corner);
  for (const auto& file :
       {folder.file("text.ply", header("ascii") + "0.1234567890123456 0 0 255\n1 0 0 255\n"
                                                  "1 1 0 255\n0 1 0 255\n4 0 1 2 3\n"),
        folder.file("little.ply", header("binary_little_endian") + little),
        folder.file("big.ply", header("binary_big_endian") + big)}) {
    const MeshData mesh = read_mesh(file, 2);
    ASSERT_EQ(mesh.triangles.cols(), 2) << file;
    EXPECT_EQ(mesh.triangles.col(1), Eigen::Vector3i(0, 2, 3));
    EXPECT_EQ(mesh.X.col(2), Vec3(2, 2, 0));
    EXPECT_EQ(mesh.X(0, 0), 2 * 0.1234567890123456);
  }
}

TEST(MeshIo, DamagedPlyIsAnInputErrorOrASoundMesh) {
  const TemporaryFolder folder;
  const std::string whole =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  std::mt19937 random(11);
  int errors = 0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string text = whole;
    text[random() % text.size()] = static_cast<char>(random() & 0xff);
    try {
      const MeshData mesh = read_mesh(folder.file("m.ply", text), 1);
      EXPECT_LT(mesh.triangles.maxCoeff(), mesh.X.cols());
    } catch (const InputError&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, kTrials / 4);  // both cases occur
  EXPECT_LT(errors, kTrials);
}

TEST(MeshIo, ObjKeepsSharedVerticesWithSeveralNormalsAndFullPrecision) {
  const TemporaryFolder folder;
  const auto file = folder.file("m.obj",
                                "# a comment\r\no thing\r\nv 0.1234567890123456 0 0\r\nv 1 0 0\r\n"
                                "v 1 1 0\r\nv +0 1e0 0\r\nvn 0 0 1\r\nvn 0 1 0\r\n"
                                "f 1//1 2//1 3//1\r\nf 1/1/2 3//2 -1\r\n");
  const MeshData mesh = read_mesh(file, 1);
  EXPECT_EQ(mesh.X.cols(), 4);
  EXPECT_EQ(mesh.X(0, 0), 0.1234567890123456);
  EXPECT_EQ(mesh.triangles.col(0), Eigen::Vector3i(0, 1, 2));
  EXPECT_EQ(mesh.triangles.col(1), Eigen::Vector3i(0, 2, 3));
}

TEST(MeshIo, AnAbaqusDeckIsRefusedInOneReadableLineWhateverItHolds) {
  const TemporaryFolder folder;
  for (const std::string deck :
       {"*NODE\n1\x01, 0, 0, 0\n", "*NODE\n1, 0, \x1b[2J, 0\n",
        "*ELEMENT, TYPE=C3D4\n\x7f, 1, 2, 3, 4\n", "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, \x01\n",
        "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=\x1b[2J\n"}) {
    const std::string message = refusal(folder.file("m.inp", deck));
    EXPECT_TRUE(is_readable_line(message)) << message;
  }
}

// A device may have no end, and a pipe nobody at the other end.
TEST(MeshIo, AMeshIsNoDevice) {
  const TemporaryFolder folder;
  for (const char* const name : {"m.ply", "m.stl", "m.vtu"}) {
    std::filesystem::create_symlink("/dev/zero", folder / name);
    EXPECT_NE(refusal(folder / name).find("is no regular file"), std::string::npos);
  }
}

// Keywords in any case and with spaces, elements before their nodes, numbers with gaps, several
// blocks, comments, an element set, Windows line ends, elements and blocks of other kinds.
TEST(MeshIo, AbaqusDeckIsRead) {
  const TemporaryFolder folder;
  const auto file = folder.file("m.inp",
                                "*Heading\n 1, 2, anything\n** comment\n"
                                "*Element , ELSET = disc , Type = c3d4\r\n7, 100, 20, 3, 5\r\n"
                                "*NODE, NSET=all\n100, 0., 0, 0\n20, 1, 0, 0,\n ** comment\n"
                                "*ELEMENT, type=CPS3, ELSET=Surface0\n1, 100, 20, 3\n"
                                "*NODE OUTPUT\nU, V\n*node\n 3 , 0 , 1 , 0\n5,0,0,+1.5e0\n");
  const MeshData mesh = read_mesh(file, 1);
  EXPECT_EQ(mesh.X.cols(), 4);
  EXPECT_EQ(mesh.tets, Eigen::Vector4i(0, 1, 2, 3));
  EXPECT_EQ(mesh.X.col(3), Vec3(0, 0, 1.5));
  EXPECT_EQ(mesh.triangles.cols(), 0);
}

struct BadText {
  const char* ending;
  const char* text;
  const char* message;  // after the file's name
};

TEST(MeshIo, WhatIsWrongInATextFileIsNamedWithItsLine) {
  const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4\n";
  const std::vector<BadText> cases = {
      {".inp", "1, 1, 2, 3, 9\n", ":7: unknown node 9"},
      {".inp", "1, 1, 2, 3\n",
       ":7: found 4 columns, expected 5: element number and 4 node numbers"},
      {".inp", "1, 1, 2, 3, x\n", ":7: `x` is not a node number"},
      {".inp", "*NODE\n5, 0, 0\n", ":8: found 3 columns, expected 4: node number, x, y, z"},
      {".inp", "*NODE\n5, 0, 0, 1.0.0\n", ":8: `1.0.0` is not a finite number"},
      {".inp", "*NODE\n5, 0, 0, nan\n", ":8: `nan` is not a finite number"},
      {".inp", "*NODE\n5, 0, 0, 1e999\n", ":8: `1e999` is not a finite number"},
      {".inp", "*NODE\n4, 0, 0, 1\n", ":8: node 4 is there twice"},
      {".inp", "*INCLUDE, INPUT=other.inp\n", ":7: data in another file"},
      {".inp", "*SYSTEM\n5., 0., 0.\n", ":7: *SYSTEM is not read"},
      {".inp", "*NGEN, NSET=a\n1, 4, 1\n", ":7: *NGEN is not read"},
      {".inp", "*ELGEN\n1, 2, 1, 1\n", ":7: *ELGEN is not read"},
      {".inp", "*NCOPY, CHANGE NUMBER=10, OLD SET=a, SHIFT\n", ":7: *NCOPY is not read"},
      {".inp", "*ELCOPY, ELEMENT SHIFT=10\n", ":7: *ELCOPY is not read"},
      {".inp", "*NODE, SYSTEM=C\n5, 1, 90, 0\n", ":7: nodes in a cylindrical or spherical"},
      {".inp", "*ELEMENT, TYPE=C3D10\n1,1,2,3,4\n",
       ":7: elements of kind `C3D10` have nodes between their corners; expected elements of "
       "first "},
      {".inp", "*ELEMENT, TYPE=T3D2\n1,1,2\n",
       ": holds no elements of type C3D4 (linear tetrahedra) or another that is read; there are "
       "elements of type T3D2"},
      {".inp", "1, 1, 2, 3, 4\n*NSET, NSET=top\n1, no\n", ":9: unknown set `no`"},
      {".inp", "1, 1, 2, 3, 4\n*NSET, NSET=top\n1, 9\n", ":9: unknown node 9"},
      {".inp", "1, 1, 2, 3, 4\n*ELSET, ELSET=disc\n1, 7\n", ":9: unknown element 7"},
      {".inp", "1, 1, 2, 3, 4\n*NSET, NSET=top, GENERATE\n4, 1, 1\n",
       ":9: expected a first number, a last one that is not smaller, a positive step"},
      {".inp", "1, 1, 2, 3, 4\n*SURFACE, NAME=top\n1, S6\n", ":9: element 1 has no face S6"},
      {".inp", "1, 1, 2, 3, 4\n*INSTANCE, NAME=a\n0, 0, 5\n", ":9: an *INSTANCE that is moved"},
      {".msh", "$MeshFormat\n4 0 8\n", ":2: the mesh has Gmsh's version 4; expected 2.2 or 4.1"},
      {".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 x\n$EndNodes\n",
       ":6: `x` is not a finite number: expected a coordinate"},
      {".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Elements\n1\n1 11 0 1\n$EndElements\n",
       ":6: elements of kind `Gmsh's type 11` have nodes between their corners"},
      {".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n",
       ":5: the section $Nodes has no $EndNodes"},
      {".mesh", "MeshVersionFormatted 2\nDimension 2\n", ":2: the mesh is flat"},
      {".mesh", "MeshVersionFormatted 2\nTetrahedraP2\n", ":2: elements of kind `TetrahedraP2`"},
      {".mesh", "MeshVersionFormatted 2\nVertices 1\n0 0 0\n",
       ":4: the file ends; expected a vertex's reference"},
      {".bdf", "GRID,1,,0,0,a\n", ":1: field 6 of GRID is `a`, expected a coordinate"},
      {".bdf", "GRID,1,5,0,0,0\n", ":1: nodes have a coordinate system of their own"},
      {".bdf", "GRDSET,,5\nGRID,1,,0,0,0\n", ":1: nodes have a coordinate system of their own"},
      {".bdf", "CTETRA,1,1,2,3,4,5\n", ":1: unknown node 2"},
      {".bdf", "CTETRA,1,1,2,3,4,5,6,7,\n,8,9,10,11\n",
       ":1: elements of kind `CTETRA with more than 4 nodes`"},
      {".feb", "<febio_spec version=\"1.2\"/>\n", ":1: found version `1.2` of FEBio's format"},
      {".feb",
       "<febio_spec version=\"4.0\"><Mesh>\n<Nodes><node id=\"1\">0,0</node></Nodes></Mesh>"
       "</febio_spec>",
       ":2: \"0,0\" is not three finite numbers"},
      {".feb", "<febio_spec version=\"4.0\"><Mesh>\n<Elements type=\"tet10\"/></Mesh></febio_spec>",
       ":2: elements of kind `tet10` have nodes between their corners"},
      {".feb",
       "<febio_spec version=\"4.0\"><Mesh>\n<NodeSet name=\"a\">1:9</NodeSet></Mesh></febio_spec>",
       ":2: found more numbers than the 0 that can be"},
      {".obj", "v 0 0 0\nv 1 0 inf\n", ":2: `inf` is not a finite number"},
      {".obj", "v 0 0\n", ":1: a vertex needs 3 coordinates"},
      {".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", ":4: unknown vertex 4"},
      {".obj", "v 0 0 0\nf 1 2 -2\n", ":2: unknown vertex -2"},
      {".obj", "v 0 0 0\nf 1 a 1\n", ":2: `a` is not a corner of a face"},
      {".obj", "v 0 0 0\nf 1 1\n", ":2: a face needs 3 corners or more"}};
  const TemporaryFolder folder;
  for (const BadText& bad : cases) {
    const std::string before = std::string(bad.ending) == ".inp" ? nodes : "";
    const auto file = folder.file(std::string("bad") + bad.ending, before + bad.text);
    const std::string message = error_of(file);
    EXPECT_EQ(message.rfind(file.string() + bad.message, 0), 0U) << message;
  }
}

TEST(MeshIo, MissingEmptyAndGarbageFilesAreInputErrorsInOneLine) {
  const TemporaryFolder folder;
  std::string noise(5000, '\0');
  std::mt19937 random(3);
  for (char& c : noise) c = static_cast<char>(random() & 0xff);
  for (const std::string ending : kEndings) {
    const std::string missing = (folder / ("none" + ending)).string();
    EXPECT_EQ(error_of(missing), missing + ": no such mesh file");
    const std::string empty = folder.file("empty" + ending, "").string();
    EXPECT_EQ(error_of(empty), empty + ": the mesh file is empty");
    for (const std::string& text : {std::string("hello\nworld\n"), noise, std::string("<a><b/>"),
                                    std::string("solid x\nnot a facet\n"), std::string("ply\n")}) {
      const std::string garbage = folder.file("garbage" + ending, text).string();
      EXPECT_EQ(error_of(garbage).rfind(garbage + ":", 0), 0U) << error_of(garbage);
    }
  }
  std::filesystem::create_directory(folder / "folder.vtu");
  EXPECT_NE(error_of(folder / "folder.vtu").find("is a folder"), std::string::npos);
}

TEST(MeshIo, UnknownEndingsAreRefusedWithTheKnownOnes) {
  EXPECT_EQ(error_of("m.foo"),
            "m.foo: unknown mesh format `.foo`; known: .vtu, .vtp, .vtk, .stl, .obj, .ply, .inp, "
            ".msh, .feb, .bdf, .nas, .mesh, .ele, .node");
}

/// A .vtu in text with 4 points, of which the last has this z, and one cell.
std::string text_vtu(const std::string& z, const std::string& connectivity, int type) {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid>"
         "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>"
         "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
         "0 0 0 1 0 0 0 1 0 0 0 " +
         z +
         "</DataArray></Points><Cells>"
         "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" +
         connectivity +
         "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" +
         std::to_string(type) + "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

TEST(MeshIo, ACellsPointsAndItsTypeAreChecked) {
  constexpr int kTetrahedron = 10, kQuad = 9, kPolyLine = 4, kQuadraticEdge = 21;
  const TemporaryFolder folder;
  const auto error = [&](const std::string& text) { return error_of(folder.file("m.vtu", text)); };
  EXPECT_EQ(error(text_vtu("1", "0 1 2 3", kTetrahedron)), "no error");
  EXPECT_EQ(error(text_vtu("1", "0 1 2 3", kQuad)), "no error");
  EXPECT_NE(error(text_vtu("1", "0 1 2 7", kTetrahedron)).find("refers to point 7"),
            std::string::npos);
  EXPECT_NE(error(text_vtu("1", "0 1 2 -1", kTetrahedron)).find("refers to point -1"),
            std::string::npos);
  EXPECT_NE(error(text_vtu("nan", "0 1 2 3", kTetrahedron)).find("m.vtu"), std::string::npos);
  EXPECT_NE(error(text_vtu("1", "0 1 2 3", kPolyLine)).find("no tetrahedra and no surface"),
            std::string::npos);
  EXPECT_NE(error(text_vtu("1", "0 1 2 3", kQuadraticEdge)).find("VTK's type 21"),
            std::string::npos);
}

// Some programs write "solid" into the head of binary files.
TEST(MeshIo, AnStlIsBinaryIfItIsAsLongAsItsTriangles) {
  const TemporaryFolder folder;
  std::string binary = "solid but binary";
  binary.resize(80, ' ');
  const auto append = [&](const auto& value) {
    binary.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(std::uint32_t{2});
  for (const std::array<float, 12>& facet :
       {std::array<float, 12>{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0},
        std::array<float, 12>{0, 0, 1, 1, 0, 0, 1, 0, 0, 5, 5, 5}}) {  // the second is flat
    append(facet);
    append(std::uint16_t{0});
  }
  EXPECT_EQ(read_mesh(folder.file("m.stl", binary), 1).triangles, Eigen::Vector3i(0, 1, 2));
  EXPECT_NE(error_of(folder.file("cut.stl", binary.substr(0, 150))), "no error");
  binary.replace(0, 5, "xxxxx");
  EXPECT_NE(error_of(folder.file("cut.stl", binary.substr(0, 150))).find("2 triangles"),
            std::string::npos);
}

TEST(MeshIo, ADamagedStlInTextIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& text) {
    return error_of(folder.file("m.stl", "solid s\nfacet normal 0 0 1\nouter loop\n" + text));
  };
  EXPECT_NE(
      error("vertex 0 0 0\nvertex 1 0 x\n").find("m.stl:5: not readable as .stl: expected three"),
      std::string::npos);
  EXPECT_NE(error("vertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n").find("has 2 corners"),
            std::string::npos);
  EXPECT_NE(error("vertex 0 0 0\nvertex 1 0 0\n").find("ends within a facet"), std::string::npos);
}

// A mesh may lie behind a link to what is nobody's business.
TEST(MeshIo, AFileThatIsNoMeshIsNotQuoted) {
  const TemporaryFolder folder;
  for (const std::string secret :
       {"secret:x:0:0", "v secret 1 2", "f secret 1 2", "# secret", "*secret"})
    for (const std::string ending : kEndings) {
      const std::string error = error_of(folder.file("m" + ending, secret + "\n"));
      EXPECT_NE(error, "no error");
      EXPECT_EQ(error.find("secret"), std::string::npos) << error;
    }
}

TEST(MeshIo, APlyThatClaimsMoreThanItHasIsRefusedAtOnce) {
  const TemporaryFolder folder;
  for (const std::string properties : {"", "property float x\n"})
    EXPECT_NE(
        error_of(folder.file("m.ply", "ply\nformat ascii 1.0\nelement vertex 1000000000000\n" +
                                          properties + "end_header\n"))
            .find("more than it has bytes"),
        std::string::npos);
}

TEST(MeshIo, CutOffFilesAreInputErrors) {
  const TemporaryFolder folder;
  write_mesh(folder / "m.vtu", two_tetrahedra(), 1);
  const std::string whole = content(folder / "m.vtu");
  // Only the closing tags may be missing unnoticed.
  for (std::size_t size = 1; size + 40 < whole.size(); size += whole.size() / 23) {
    const auto file = folder.file("cut.vtu", whole.substr(0, size));
    EXPECT_NE(error_of(file), "no error") << size << " of " << whole.size();
  }
}

TEST(MeshIo, ThreadsThatReadDamagedFilesAtOnceEachGetTheirError) {
  const TemporaryFolder folder;
  write_mesh(folder / "m.vtu", two_tetrahedra(), 1);
  const std::string whole = content(folder / "m.vtu");
  const auto cut = folder.file("cut.vtu", whole.substr(0, whole.size() / 2));
  constexpr int kFiles = 200;
  std::atomic<int> errors = 0, meshes = 0;
  const auto read_all = [&] {
    for (int i = 0; i < kFiles; ++i) {
      try {
        read_mesh(i % 2 == 0 ? cut : folder / "m.vtu", 1);
        ++meshes;
      } catch (const InputError&) {
        ++errors;
      }
    }
  };
  { const std::jthread one(read_all), two(read_all); }
  EXPECT_EQ(errors, kFiles);
  EXPECT_EQ(meshes, kFiles);
}

TEST(MeshIo, AFailedWriteNamesTheFileAndLeavesNothing) {
  const TemporaryFolder folder;
  folder.file("plain", "text");
  std::filesystem::create_directory(folder / "folder.vtu");
  std::filesystem::create_symlink("/dev/full", folder / "full.vtu");
  for (const std::string name : {"plain/m.vtu", "missing/m.vtu", "folder.vtu", "full.vtu"}) {
    const std::string file = (folder / name).string();
    try {
      write_mesh(file, two_tetrahedra(), 1);
      ADD_FAILURE() << name << " was written";
    } catch (const SystemError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(file + ": can't be written: ", 0), 0U)
          << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(file + ".part"));
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  EXPECT_THROW(write_mesh(folder / "m.vtp", two_tetrahedra(), 1), InputError);
}

TEST(MeshIo, VolumesOfTheDataFilesAreAsTheirReadmesSay) {
  const char* const data = std::getenv("ARTICULAR_DATA");
  if (data == nullptr || !std::filesystem::is_directory(data))
    GTEST_SKIP() << "ARTICULAR_DATA names no folder with the data files";
  struct Known {
    const char* file;
    int num_nodes, num_cells;
    double volume;  // [mm³], as rounded in the README; [file unit³] for the .vtu
  };
  for (const Known& known :
       {Known{"jaw/mandible.obj", 20882, 41760, 57635},
        Known{"knee/femcart.obj", 13290, 26584, 13972}, Known{"tmj/disc_left.obj", 2713, 5422, 523},
        Known{"tmj/disc_left_tet.inp", 3051, 10482, 519},
        Known{"tmj/disc_right_tet.inp", 2372, 7480, 502},
        Known{"verification/block_n4.vtu", 125, 384, 1},
        Known{"verification/cook_n8.vtu", 162, 384, 8640}}) {
    const std::filesystem::path file = std::filesystem::path(data) / known.file;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    const MeshData mesh = read_mesh(file, kMillimetre);
    EXPECT_EQ(mesh.X.cols(), known.num_nodes) << file;
    EXPECT_EQ(mesh.tets.cols() + mesh.triangles.cols(), known.num_cells) << file;
    EXPECT_NEAR(volume(mesh) * 1e9, known.volume, 0.5) << file;
  }
}

}  // namespace articular::sim::mesh_io_test
