// `articular collide` with wrong input: the exit code, one clear line, nothing half written.
#include <gtest/gtest.h>

#include <limits>

#include "tests/tools/collide/collide_meshes.hpp"
#include "tests/tools/support/program.hpp"

namespace articular::collide_error_test {

struct WrongCall {
  const char* name;
  const char* arguments;
  int exit_code;
  const char* fragment;  // of the message
};

void PrintTo(const WrongCall& call, std::ostream* out) { *out << call.name; }

class WrongCalls : public ::testing::TestWithParam<WrongCall> {
 protected:
  WrongCalls() {
    Tetrahedra tets(4, 2);
    tets << 0, 1, 1, 2, 2, 3, 3, 4;
    Positions x(3, 5);
    x << 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1;
    write_vtk(folder_ / "good_0.vtk", tets, x);
    write_vtk(folder_ / "good_1.vtk", tets, x);
    write_vtk(folder_ / "good_2.vtk", tets, x);
    for (const char* const name : {"two_0.vtk", "two_1.vtk"}) write_vtk(folder_ / name, tets, x);
    write_vtk(folder_ / "nodes_0.vtk", tets, x);
    write_vtk(folder_ / "nodes_1.vtk", tets.leftCols(1), x);
    write_vtk(folder_ / "tets_0.vtk", tets, x);
    write_vtk(folder_ / "tets_1.vtk", tets.rowwise().reverse(), x);
    write_vtk(folder_ / "twice.vtk", Eigen::Vector4i(0, 1, 1, 2), x);
    Positions flat = x;
    flat.row(2).setZero();
    write_vtk(folder_ / "flat.vtk", tets, flat);
    x(1, 3) = std::numeric_limits<double>::quiet_NaN();
    write_vtu(folder_ / "nan.vtu", tets, x);
    x(1, 3) = 1e200;
    write_vtu(folder_ / "far_1.vtu", tets, x);
    x(1, 3) = 0;
    write_vtu(folder_ / "far_0.vtu", tets, x);
    folder_.file("surface.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder_.file("damaged.vtk", "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTR");
    folder_.file("text.pvd", "no XML");
    folder_.file("bones.pvd",
                 "<VTKFile><Collection><DataSet timestep=\"0\" name=\"skull\" "
                 "file=\"skull_0.vtp\"/></Collection></VTKFile>");
    folder_.file("same.pvd",
                 "<VTKFile><Collection><DataSet timestep=\"0\" file=\"good_0.vtk\"/>"
                 "<DataSet timestep=\"0\" file=\"good_1.vtk\"/></Collection></VTKFile>");
    folder_.file("file", "");
  }
  TemporaryFolder folder_;
};

TEST_P(WrongCalls, GiveOneClearLineAndWriteNothing) {
  for (const char* more : {"", " --json"}) {
    const ProgramResult result =
        run_program(folder_, std::string("collide ") + GetParam().arguments + more);
    EXPECT_EQ(result.exit_code, GetParam().exit_code);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(GetParam().fragment), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "pairs.csv"));
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Collide, WrongCalls,
    ::testing::Values(
        WrongCall{"NoMesh", "", 2, "required"},
        WrongCall{"EmptyName", "good_0.vtk \"\"", 2, "empty name"},
        WrongCall{"UnquotedPattern", "good_*.vtk", 2, "in quotes"},
        WrongCall{"NoSuchFile", "nothing.vtu", 2, "nothing.vtu: no such mesh file"},
        WrongCall{"NoSuchSecondFile", "good_0.vtk nothing.vtu", 2, "nothing.vtu"},
        WrongCall{"NoMatch", "'nothing_*.vtk'", 2, "nothing_*.vtk: no file matches"},
        WrongCall{"NoTetrahedra", "good_0.vtk surface.obj", 2, "surface.obj: holds no tetrahedra"},
        WrongCall{"UnknownFormat", "good_0.vtk file", 2, "unknown mesh format"},
        WrongCall{"Folder", ".", 2, "mesh"},
        WrongCall{"DamagedMesh", "damaged.vtk", 2, "damaged.vtk:4: not readable"},
        WrongCall{"NodeTwiceInOneTetrahedron", "twice.vtk", 2, "twice.vtk: tetrahedron 0"},
        WrongCall{"OtherNodeCount", "'nodes_*.vtk'", 2, "nodes_1.vtk: has 4 nodes, not the 5 of"},
        WrongCall{"OtherConnectivity", "'tets_*.vtk'", 2, "tets_1.vtk: tetrahedron 0 has other"},
        WrongCall{"OtherNumberOfFrames", "'good_*.vtk' 'two_*.vtk'", 2, "3 frames"},
        WrongCall{"NotFinite", "nan.vtu", 2, "nan.vtu: the position of point 3"},
        WrongCall{"TooFarAway", "'far_*.vtu'", 2, "far_1.vtu: point 3"},
        WrongCall{"NoPvd", "nothing.pvd", 2, "nothing.pvd"},
        WrongCall{"PvdThatIsNone", "text.pvd", 2, "text.pvd:1: not readable as .pvd"},
        WrongCall{"PvdOfBones", "bones.pvd", 2, "bones.pvd: lists no meshes with tetrahedra"},
        WrongCall{"PvdOfOneTime", "same.pvd", 2, "good_0.vtk and good_1.vtk for the same time"},
        WrongCall{"PvdWithoutThatBody", "same.pvd:disc", 2, "has no body `disc`"},
        WrongCall{"RepeatNever", "good_0.vtk --repeat 0", 2, "--repeat"},
        WrongCall{"RepeatNegative", "good_0.vtk --repeat -1", 2, "--repeat"},
        WrongCall{"RepeatNoNumber", "good_0.vtk --repeat two", 2, "--repeat"},
        WrongCall{"NoThreads", "good_0.vtk --threads 0", 2, "--threads"},
        WrongCall{"NegativeThreads", "good_0.vtk --threads -2", 2, "--threads"},
        WrongCall{"MarginWithUnit", "good_0.vtk --margin '0.1 mm'", 2, "without a unit"},
        WrongCall{"NegativeMargin", "good_0.vtk --margin -0.1", 2, "--margin"},
        WrongCall{"MarginNotFinite", "good_0.vtk --margin nan", 2, "--margin"},
        WrongCall{"UnknownNarrow", "good_0.vtk --narrow set", 2, "sat"},
        WrongCall{"UnknownMethod", "good_0.vtk --method block", 2, "did you mean `blocks`?"},
        WrongCall{"ArticleWithSat", "good_0.vtk --method article --narrow sat", 2, "--narrow sat"},
        WrongCall{"ArticleWithThreads", "good_0.vtk --method article --threads 2", 2, "--threads"},
        WrongCall{"ArticleWithFlatRestShape", "flat.vtk --method article", 2, "flat.vtk: "},
        WrongCall{"TableWithoutName", "good_0.vtk --pairs ''", 2, "--pairs"},
        WrongCall{"TableInNoFolder", "good_0.vtk --pairs no/pairs.csv", 4, "no/pairs.csv"},
        WrongCall{"TableInAFile", "good_0.vtk --pairs file/pairs.csv", 4, "file/pairs.csv"},
        WrongCall{"TableOnFullDisk", "good_0.vtk --pairs /dev/full", 4, "/dev/full"},
        WrongCall{"NoMeshForTheTable", "nothing.vtu --pairs pairs.csv", 2, "nothing.vtu"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Collide, FlatAndInvertedElementsAreNoErrorForBlocks) {
  const TemporaryFolder folder;
  const Mesh mesh = collision::testing::box_mesh(2, 2, 2, 1);
  Positions flat = mesh.X, mirrored = mesh.X;
  flat.row(2).setZero();
  mirrored.row(2) *= -1;
  write_vtk(folder / "f_0.vtk", mesh.tets, flat);
  write_vtk(folder / "f_1.vtk", mesh.tets, mirrored);
  write_vtk(folder / "f_2.vtk", mesh.tets, mesh.X);
  const ProgramResult result = run_program(folder, "collide 'f_*.vtk' f_2.vtk");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST(Collide, InterruptedSearchSaysSoAndWritesNothing) {
  const TemporaryFolder folder;
  VShapes shapes;
  write_vtk(folder / "v.vtk", shapes.bar.tets, shapes.upright(-0.3));
  const ProgramResult result =
      run_shell(folder,
                "\"$articular\" collide v.vtk --repeat 1000000 --pairs pairs.csv & pid=$!; "
                "sleep 0.5; kill -TERM $pid; wait $pid");
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("articular: interrupted"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "pairs.csv"));
}

}  // namespace articular::collide_error_test
