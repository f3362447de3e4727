#include "sim/build/collider.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>
#include <set>

#include "sim/mesh/shapes.hpp"

namespace articular::sim::collider_test {

/// A triangle, turned so that its least node comes first: equal for equal orientation.
std::array<int, 3> turned(const Eigen::Vector3i& t) {
  std::array<int, 3> nodes = {t[0], t[1], t[2]};
  std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::set<std::array<int, 3>> set_of(const Triangles& triangles) {
  std::set<std::array<int, 3>> result;
  for (Eigen::Index f = 0; f < triangles.cols(); ++f) result.insert(turned(triangles.col(f)));
  return result;
}

/// A mesh's surface, with the nodes that it uses only.
MeshData surface_of(const MeshData& solid) {
  const auto surface = collision::build_surface(solid.tets, static_cast<int>(solid.X.cols()));
  std::vector<int> kept, index(static_cast<std::size_t>(solid.X.cols()), -1);
  MeshData result;
  result.triangles = surface.faces;
  for (int& node : result.triangles.reshaped()) {
    int& to = index[static_cast<std::size_t>(node)];
    if (to < 0) {
      to = static_cast<int>(kept.size());
      kept.push_back(node);
    }
    node = to;
  }
  result.X = solid.X(Eigen::all, kept);
  return result;
}

struct Shell {
  MeshData surface;
  Collider collider;
};

Shell shell_of(const MeshData& surface, double thickness) {
  Shell shell;
  shell.surface = surface;
  shell.collider.X = surface.X;
  shell.collider.tets = shell_under(shell.collider.X, shell.surface.triangles, thickness);
  std::vector<char> outer(static_cast<std::size_t>(shell.collider.X.cols()), 0);
  std::fill_n(outer.begin(), surface.X.cols(), 1);
  complete_collider(shell.collider, outer);
  return shell;
}

double least_volume(const Collider& c) {
  double least = 1e300;
  for (Eigen::Index t = 0; t < c.tets.cols(); ++t) {
    const Vec3 a = c.X.col(c.tets(0, t));
    least = std::min(least, (c.X.col(c.tets(1, t)) - a)
                                .cross(c.X.col(c.tets(2, t)) - a)
                                .dot(c.X.col(c.tets(3, t)) - a));
  }
  return least;
}

std::vector<MeshData> surfaces() {
  return {surface_of(sphere_mesh({0.01, 0.003, {1, 2, 3}})),
          surface_of(box_mesh({{0.02, 0.03, 0.01}, {4, 3, 2}, {0, 0, 1}}))};
}

TEST(Collider, AShellUnderASphereOrABoxHasPositiveTetrahedra) {
  for (const MeshData& surface : surfaces()) {
    const Shell shell = shell_of(surface, 1e-3);
    EXPECT_EQ(shell.collider.tets.cols(), 3 * surface.triangles.cols());
    EXPECT_GT(least_volume(shell.collider), 0);
  }
}

TEST(Collider, AShellsOuterFacesAreTheGivenTrianglesWithTheirOrientation) {
  for (const MeshData& surface : surfaces()) {
    const Collider collider = shell_of(surface, 1e-3).collider;
    EXPECT_EQ(collider.surface.faces.cols(), surface.triangles.cols());
    EXPECT_EQ(set_of(collider.surface.faces), set_of(surface.triangles));
  }
}

TEST(Collider, AnOpenSurfacesShellTouchesWithItsOuterSideOnly) {
  MeshData sheet;
  sheet.X.resize(3, 4);
  sheet.X << 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0.1;
  sheet.triangles.resize(3, 2);
  sheet.triangles << 0, 1, 1, 3, 2, 2;
  const Collider collider = shell_of(sheet, 0.1).collider;
  EXPECT_GT(least_volume(collider), 0);
  EXPECT_EQ(set_of(collider.surface.faces), set_of(sheet.triangles));
}

TEST(Collider, AThinShellUnderASphereHasItsThicknessAndArea) {
  const Collider collider =
      shell_of(surface_of(sphere_mesh({0.01, 0.001, Vec3::Zero()})), 1e-4).collider;
  EXPECT_NEAR(collider.size, 1e-4, 0.02 * 1e-4);  // curvature: thickness over radius is 1 %
  double area = 0;
  for (const double a : collider.face_area) area += a;
  const double exact = 4 * std::numbers::pi * 1e-4;
  EXPECT_NEAR(area, exact, 0.01 * exact);  // chords: (h/R)²
}

TEST(Collider, FacesOverWhichNoShellIsLeftAreDropped) {
  MeshData fold;  // the same triangle from both sides
  fold.X.resize(3, 3);
  fold.X << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  fold.triangles.resize(3, 2);
  fold.triangles << 0, 0, 1, 2, 2, 1;
  EXPECT_EQ(shell_under(fold.X, fold.triangles, 0.1).cols(), 0);
  EXPECT_EQ(fold.triangles.cols(), 0);
}

Collider solid(const MeshData& mesh) {
  Collider collider;
  collider.X = mesh.X;
  collider.tets = mesh.tets;
  complete_collider(collider, {});
  return collider;
}

TEST(Collider, NearbyFacesOfATetrahedronContainTheFacesAtItsNodes) {
  const Collider collider = solid(sphere_mesh({0.01, 0.002, Vec3::Zero()}));
  for (Eigen::Index t = 0; t < collider.tets.cols(); ++t) {
    const auto begin = collider.nearby.begin() + collider.nearby_begin[static_cast<std::size_t>(t)];
    const auto end =
        collider.nearby.begin() + collider.nearby_begin[static_cast<std::size_t>(t) + 1];
    EXPECT_TRUE(std::is_sorted(begin, end));
    EXPECT_EQ(std::adjacent_find(begin, end), end) << "a face twice";
    for (Eigen::Index f = 0; f < collider.surface.faces.cols(); ++f) {
      bool shares = false;
      for (const int node : collider.surface.faces.col(f))
        shares = shares || (collider.tets.col(t).array() == node).any();
      if (shares) {
        EXPECT_TRUE(std::binary_search(begin, end, static_cast<int>(f)));
      }
    }
  }
}

TEST(Collider, ElementsBelowTheSurfaceKnowTheFacesAboveThem) {
  const Collider collider = solid(box_mesh({{3, 3, 3}, {3, 3, 3}, Vec3::Zero()}));
  for (std::size_t t = 0; t + 1 < collider.nearby_begin.size(); ++t)
    EXPECT_GT(collider.nearby_begin[t + 1], collider.nearby_begin[t]);
}

// Kuhn's tetrahedra of a cube: a face of the surface is half a cell's side; the height over it is
// the cell's edge.
TEST(Collider, TheSizeOfABoxMeshIsItsCellsHeight) {
  const Collider collider = solid(box_mesh({{4, 4, 4}, {4, 4, 4}, Vec3::Zero()}));
  EXPECT_NEAR(collider.size, 1, 1e-14);
}

}  // namespace articular::sim::collider_test
