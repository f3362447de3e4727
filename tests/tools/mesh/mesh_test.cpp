// `articular mesh` as a user calls it, with its mesher.
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "collision/mesh/surface.hpp"
#include "tests/tools/mesh/closed_surfaces.hpp"
#include "tests/tools/support/program.hpp"
#include "tools/mesh/mesh_quality.hpp"

namespace articular::mesh_test {

constexpr double kUnit = 1e-3;

/// Quality of a mesh that the program wrote, against the surface that it was made from.
struct Meshed {
  tools::TetMesh mesh;
  tools::MeshQuality quality;
};

Meshed read_meshed(const std::filesystem::path& file, const sim::MeshData& surface) {
  const sim::MeshData data = sim::read_mesh(file, kUnit);
  tools::Shell shell;
  shell.X = surface.X;
  shell.triangles = surface.triangles;
  Meshed result{{data.X, data.tets}, {}};
  result.quality = tools::mesh_quality(result.mesh, shell);
  return result;
}

/// A volume that no cut facet explains: all tetrahedra have the right sign, and their surface is
/// one closed surface without handles.
void expect_one_solid(const Meshed& meshed) {
  const tools::TetMesh& mesh = meshed.mesh;
  for (const auto& tet : mesh.tets.colwise()) {
    const Vec3 a = mesh.X.col(tet(0));
    const Vec3 b = mesh.X.col(tet(1)), c = mesh.X.col(tet(2)), d = mesh.X.col(tet(3));
    EXPECT_GT((b - a).cross(c - a).dot(d - a), 0);
  }
  EXPECT_EQ(meshed.quality.parts, 1);
  const collision::Surface surface =
      collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols()));
  const auto corners = surface.faces.reshaped();
  const auto nodes =
      static_cast<Eigen::Index>(std::set<int>(corners.begin(), corners.end()).size());
  EXPECT_EQ(2 * nodes - surface.faces.cols(), 4);  // V - E + F = 2 with E = 3/2 F
}

TEST(Mesh, ABallHasItsVolumeGoodElementsAndTheSizeThatWasAskedFor) {
  const TemporaryFolder folder;
  const double radius = 10e-3;
  const sim::MeshData surface = ball({0.1, 0.2, 0.3}, radius, 4);
  sim::write_mesh(folder / "ball.vtp", surface, kUnit);
  const double volume = 4.0 / 3 * std::numbers::pi * radius * radius * radius;
  for (const double size : {2.0, 4.0}) {
    const ProgramResult result = run_program(
        folder, "mesh ball.vtp --size '" + std::to_string(size) + " mm' --out tissue.vtu");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out.substr(0, result.out.find('\n')), "tissue.vtu");
    const Meshed meshed = read_meshed(folder / "tissue.vtu", surface);
    expect_one_solid(meshed);
    EXPECT_NEAR(meshed.quality.mean_edge / kUnit, size, 0.15 * size);
    EXPECT_GT(meshed.quality.least_dihedral_deg, 8);
    EXPECT_GT(meshed.quality.median_dihedral_deg, 40);
    // A tenth of the size is what a facet may be off; its chords take volume, A·(2/3 sagitta).
    EXPECT_LT(meshed.quality.largest_distance / kUnit, 0.15 * size);
    EXPECT_LT(meshed.quality.volume, volume);
    EXPECT_GT(meshed.quality.volume, volume * (1 - 3 * 0.1 * size * kUnit / radius));
  }
}

TEST(Mesh, SharpEdgesKeepABoxExactly) {
  const TemporaryFolder folder;
  const sim::MeshData surface = cuboid({0, 0, 0}, {0.02, 0.01, 0.005});
  sim::write_mesh(folder / "box.vtp", surface, kUnit);
  const ProgramResult result =
      run_program(folder, "mesh box.vtp --size '2 mm' --edges '40 deg' --out tissue.vtu");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Meshed meshed = read_meshed(folder / "tissue.vtu", surface);
  expect_one_solid(meshed);
  EXPECT_NEAR(meshed.quality.volume, 1e-6, 1e-12);
  EXPECT_LT(meshed.quality.largest_distance, 1e-9);
  EXPECT_GT(meshed.quality.least_dihedral_deg, 8);
}

TEST(Mesh, TheSameSurfaceGivesNearlyTheSameMeshWhicheverWayItLooks) {
  const TemporaryFolder folder;
  const sim::MeshData surface = ball({0, 0, 0}, 10e-3, 3);
  sim::write_mesh(folder / "out.vtp", surface, kUnit);
  ASSERT_EQ(run_program(folder, "mesh out.vtp --size '3 mm' --out a.vtu").exit_code, 0);
  const Meshed outward = read_meshed(folder / "a.vtu", surface);
  sim::write_mesh(folder / "in.vtp", inside_out(surface), kUnit);
  ASSERT_EQ(run_program(folder, "mesh in.vtp --size '3 mm' --out c.vtu").exit_code, 0);
  const Meshed turned = read_meshed(folder / "c.vtu", surface);
  expect_one_solid(turned);
  const auto tets = static_cast<double>(outward.mesh.tets.cols());
  EXPECT_NEAR(static_cast<double>(turned.mesh.tets.cols()), tets, 0.05 * tets);
  EXPECT_NEAR(turned.quality.volume, outward.quality.volume, 0.01 * outward.quality.volume);
}

TEST(Mesh, SeveralShellsInOneFileOrOneEachAndAStrayOneDropped) {
  const TemporaryFolder folder;
  const sim::MeshData crumb = cuboid({-0.05, 0, 0}, {-0.0499, 1e-4, 1e-4});
  const sim::MeshData one = ball({0, 0, 0}, 8e-3, 3), two = ball({0.03, 0, 0}, 6e-3, 3);
  sim::write_mesh(folder / "s.vtp", joined(joined(crumb, one), two), kUnit);
  ProgramResult result = run_program(folder, "mesh s.vtp --size '3 mm' --split --out t.vtu");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("s.vtp: dropped a stray shell of 12 faces at face 1"),
            std::string::npos)
      << result.err;
  const Meshed first = read_meshed(folder / "t_1.vtu", one),
               second = read_meshed(folder / "t_2.vtu", two);
  expect_one_solid(first);
  expect_one_solid(second);
  EXPECT_LT(first.quality.largest_distance, 0.5e-3);
  EXPECT_LT(second.quality.largest_distance, 0.5e-3);
  result = run_program(folder, "mesh s.vtp --size '3 mm' --out t.vtu");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Meshed both = read_meshed(folder / "t.vtu", joined(one, two));
  const auto apart = static_cast<double>(first.mesh.tets.cols() + second.mesh.tets.cols());
  EXPECT_NEAR(static_cast<double>(both.mesh.tets.cols()), apart, 0.02 * apart);
  EXPECT_EQ(both.quality.parts, 2);
}

TEST(Mesh, ASurfaceThatCrossesItselfIsRefusedWithThePlace) {
  const TemporaryFolder folder;
  sim::MeshData bent = cuboid({0, 0, 0}, {0.01, 0.01, 0.01});
  bent.X.col(7) = Vec3(-0.005, 0.004, 0.003);  // the corner (10 10 10), out through the other side
  sim::write_mesh(folder / "bent.vtp", bent, kUnit);
  const ProgramResult result = run_program(folder, "mesh bent.vtp --size '2 mm' --out t.vtu");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("bent.vtp: faces "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(" intersect, near ("), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "t.vtu"));
}

TEST(Mesh, WhatCannotBeDoneIsSaidInOneLine) {
  const TemporaryFolder folder;
  sim::write_mesh(folder / "b.vtp", ball({0, 0, 0}, 10e-3, 2), kUnit);
  const auto expect_refused = [&](const std::string& arguments, int code, const char* what) {
    const ProgramResult result = run_program(folder, "mesh " + arguments);
    EXPECT_EQ(result.exit_code, code) << arguments;
    EXPECT_NE(result.err.find(what), std::string::npos) << arguments << "\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "");
  };
  expect_refused("b.vtp --size 2 --out t.vtu", 2, "--size: ");
  expect_refused("b.vtp --size '0 mm' --out t.vtu", 2, "--size: expected a length > 0");
  expect_refused("b.vtp --size '2 kg' --out t.vtu", 2, "--size: ");
  expect_refused("b.vtp --size '2 mm' --unit kPa --out t.vtu", 2, "--unit: ");
  expect_refused("b.vtp --size '2 mm' --edges '200 deg' --out t.vtu", 2, "--edges: ");
  expect_refused("b.vtp --size '2 mm' --out t.stl", 2, ".vtu");
  expect_refused("b.vtp --size '2 mm' --out none/t.vtu", 4, "there is no folder none");
  expect_refused("none.vtp --size '2 mm' --out t.vtu", 2, "none.vtp: no such mesh file");
  expect_refused("b.vtp --size '60 mm' --out t.vtu", 2, "smaller --size");
}

// Alone in a folder, the program has no mesher beside it.
TEST(Mesh, AMissingMesherIsAFailureOfTheSystem) {
  const TemporaryFolder folder;
  sim::write_mesh(folder / "b.vtp", ball({0, 0, 0}, 10e-3, 2), kUnit);
  const ProgramResult result = run_shell(
      folder, "cp \"$articular\" articular && ./articular mesh b.vtp --size '3 mm' --out t.vtu");
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("the mesher is missing"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "t.vtu"));
}

TEST(Mesh, AMesherThatDiesIsAFailureOfTheSystem) {
  const TemporaryFolder folder;
  sim::write_mesh(folder / "b.vtp", ball({0, 0, 0}, 10e-3, 2), kUnit);
  const ProgramResult result = run_shell(
      folder,
      "cp \"$articular\" articular && printf '#!/bin/sh\\ncat <&3 >/dev/null\\nexit 9\\n' > "
      "articular-mesher && chmod +x "
      "articular-mesher && ./articular mesh b.vtp --size '3 mm' --out t.vtu");
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("ended without an answer"), std::string::npos) << result.err;
}

TEST(Mesh, InterruptedItLeavesNothing) {
  const TemporaryFolder folder;
  sim::write_mesh(folder / "b.vtp", ball({0, 0, 0}, 10e-3, 4), kUnit);
  const ProgramResult result = run_shell(folder,
                                         "timeout --foreground --preserve-status -s INT 1 "
                                         "\"$articular\" mesh b.vtp --size '0.1 mm' --out t.vtu");
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_NE(result.err.find("interrupted; nothing was written"), std::string::npos) << result.err;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_NE(entry.path().extension(), ".vtu") << entry.path();
}

}  // namespace articular::mesh_test
