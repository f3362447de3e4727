// Which surfaces `articular mesh` takes, and what it says of the others.
#include "tools/mesh/mesh_surface.hpp"

#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.hpp"
#include "tests/tools/mesh/closed_surfaces.hpp"

namespace articular::tools::mesh_surface_test {

constexpr double kUnit = 1e-3, kSize = 1e-3;
const Vec3 kZero = Vec3::Zero(), kOne = Vec3::Constant(0.01);

Shells shells_of(const sim::MeshData& mesh) { return closed_shells("s.obj", mesh, kUnit, kSize); }

std::string refusal(const sim::MeshData& mesh) {
  try {
    shells_of(mesh);
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "taken";
}

void expect_says(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
}

sim::MeshData without_face(sim::MeshData mesh, Eigen::Index face) {
  mesh.triangles.col(face) = mesh.triangles.rightCols(1).eval();
  mesh.triangles.conservativeResize(3, mesh.triangles.cols() - 1);
  return mesh;
}

TEST(MeshSurface, TwoCuboidsAreTwoShellsWithTheirVolumes) {
  const Shells found = shells_of(joined(cuboid(kZero, kOne), cuboid(2 * kOne, {0.03, 0.04, 0.05})));
  ASSERT_EQ(found.shells.size(), 2u);
  EXPECT_NEAR(found.shells[0].volume, 1e-6, 1e-18);
  EXPECT_NEAR(found.shells[1].volume, 0.01 * 0.02 * 0.03, 1e-18);
  EXPECT_EQ(found.shells[1].face_numbers.front(), 12);
  EXPECT_TRUE(found.stray.empty());
}

TEST(MeshSurface, LooksOutwardWhicheverWayTheFileDoes) {
  const sim::MeshData good = cuboid(kZero, kOne);
  sim::MeshData mixed = good;
  std::swap(mixed.triangles(0, 3), mixed.triangles(1, 3));
  for (const sim::MeshData& mesh : {good, inside_out(good), mixed, inside_out(mixed)}) {
    const Shell shell = shells_of(mesh).shells.at(0);
    for (const auto& t : shell.triangles.colwise()) {
      const Vec3 a = shell.X.col(t(0)), b = shell.X.col(t(1)), c = shell.X.col(t(2));
      EXPECT_GT((b - a).cross(c - a).dot(a - 0.5 * kOne), 0);
    }
  }
}

TEST(MeshSurface, PointsAtOnePlaceAreOnePoint) {
  const sim::MeshData mesh = cuboid(kZero, kOne);
  sim::MeshData apart;  // each triangle has corners of its own, as in .stl
  apart.X.resize(3, 36);
  apart.triangles.resize(3, 12);
  for (int i = 0; i < 36; ++i) {
    apart.X.col(i) = mesh.X.col(mesh.triangles(i % 3, i / 3));
    apart.triangles(i % 3, i / 3) = i;
  }
  EXPECT_EQ(shells_of(apart).shells.at(0).X.cols(), 8);
}

TEST(MeshSurface, StrayShellsAreDropped) {
  sim::MeshData leaf;  // two triangles back to back
  leaf.X.resize(3, 3);
  leaf.X << 0, 0.01, 0, 0.1, 0.1, 0.12, 0, 0, 0;
  leaf.triangles.resize(3, 2);
  leaf.triangles << 0, 0, 1, 2, 2, 1;
  const sim::MeshData crumb = cuboid(3 * kOne, 3 * kOne + Vec3::Constant(1e-4));
  const Shells found = shells_of(joined(joined(leaf, cuboid(kZero, kOne)), crumb));
  ASSERT_EQ(found.shells.size(), 1u);
  EXPECT_NEAR(found.shells[0].volume, 1e-6, 1e-18);
  ASSERT_EQ(found.stray.size(), 2u);
  EXPECT_EQ(found.stray[0].faces, 2);
  EXPECT_EQ(found.stray[0].first_face, 0);
  EXPECT_EQ(found.stray[1].faces, 12);
  EXPECT_EQ(found.stray[1].first_face, 14);
  expect_says(refusal(leaf), {"s.obj: ", "no surface that encloses", "--size"});
}

TEST(MeshSurface, OpenSurfacesAreRefusedWithTheEdge) {
  expect_says(refusal(without_face(cuboid(kZero, kOne), 4)),
              {"s.obj: ", "the surface is open", "face ", "one of 3 open edges",
               "between (0 0 0) and (10 0 0)"});
}

TEST(MeshSurface, ThreeFacesAtAnEdgeAreRefusedWithTheirNumbers) {
  sim::MeshData fin = cuboid(kZero, kOne);
  fin.X.conservativeResize(3, 9);
  fin.X.col(8) = Vec3(-0.01, -0.01, 0);
  fin.triangles.conservativeResize(3, 13);
  fin.triangles.col(12) = Eigen::Vector3i(0, 4, 8);
  fin.triangles.conservativeResize(3, 14);
  fin.triangles.col(13) = Eigen::Vector3i(4, 0, 8);
  expect_says(refusal(fin), {"faces ", " 13 ", "share the edge between (0 0 0) and (0 0 10)"});
}

TEST(MeshSurface, PartsThatTouchInAPointAreRefusedWithIt) {
  expect_says(refusal(joined(cuboid(kZero, kOne), cuboid(kOne, 2 * kOne))),
              {"touch in one point, (10 10 10)"});
}

TEST(MeshSurface, ASurfaceWithOneSideIsRefused) {
  // The projective plane with six points: closed, two faces at each edge.
  sim::MeshData plane;
  plane.X.resize(3, 6);
  plane.X << 0, 10, 0, 0, 7, 3, 0, 0, 10, 0, 5, 8, 0, 0, 0, 10, 2, 6;
  plane.X *= 1e-3;
  plane.triangles.resize(3, 10);
  plane.triangles << 0, 0, 0, 0, 0, 1, 2, 3, 1, 1,  //
      1, 2, 3, 4, 5, 2, 3, 4, 3, 4,                 //
      2, 3, 4, 5, 1, 4, 5, 1, 5, 5;
  plane.triangles.col(5) = Eigen::Vector3i(1, 2, 4);
  plane.triangles.col(6) = Eigen::Vector3i(2, 3, 5);
  plane.triangles.col(7) = Eigen::Vector3i(3, 4, 1);
  plane.triangles.col(8) = Eigen::Vector3i(4, 5, 2);
  plane.triangles.col(9) = Eigen::Vector3i(5, 1, 3);
  expect_says(refusal(plane), {"one side only", "faces "});
}

TEST(MeshSurface, AShellInsideAnotherIsRefused) {
  expect_says(refusal(joined(cuboid(kZero, kOne), cuboid(0.3 * kOne, 0.7 * kOne))),
              {"the shell of face 13 reaches into that of face 1", "(3 3 3)"});
}

}  // namespace articular::tools::mesh_surface_test
