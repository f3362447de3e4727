#pragma once

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "tools/anatomy/anatomy_mesh.hpp"

/// What a mesh of an anatomy is asked for.
namespace articular::anatomy {

constexpr double kDegree = std::numbers::pi / 180;

/// The least volume of a tetrahedron, by its longest edge cubed: 0.118 in a regular one.
inline double least_relative_volume(const Mesh& mesh) {
  double least = 1;
  for (const auto& tet : mesh.tets.colwise()) {
    double longest = 0;
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b)
        longest = std::max(longest, (mesh.X_mm.col(tet(a)) - mesh.X_mm.col(tet(b))).norm());
    const Vec3 x0 = mesh.X_mm.col(tet(0));
    const double volume = (mesh.X_mm.col(tet(1)) - x0)
                              .cross(mesh.X_mm.col(tet(2)) - x0)
                              .dot(mesh.X_mm.col(tet(3)) - x0) /
                          6;
    least = std::min(least, volume / (longest * longest * longest));
  }
  return least;
}

inline double volume_of(const Mesh& mesh, Eigen::Index e) {  // of a tetrahedron
  const Eigen::Vector4i tet = mesh.tets.col(e);
  const Vec3 x0 = mesh.X_mm.col(tet(0));
  return (mesh.X_mm.col(tet(1)) - x0)
             .cross(mesh.X_mm.col(tet(2)) - x0)
             .dot(mesh.X_mm.col(tet(3)) - x0) /
         6;
}

inline double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) sum += volume_of(mesh, e);
  return sum;
}

/// Faces that belong to one tetrahedron only, outward.
inline Triangles boundary(const Tetrahedra& tets) {
  static constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  std::map<std::array<int, 3>, std::pair<int, Eigen::Vector3i>> faces;
  for (Eigen::Index e = 0; e < tets.cols(); ++e)
    for (const auto& f : kFaces) {
      const Eigen::Vector3i face(tets(f[0], e), tets(f[1], e), tets(f[2], e));
      std::array<int, 3> key = {face(0), face(1), face(2)};
      std::sort(key.begin(), key.end());
      auto& entry = faces[key];
      ++entry.first;
      entry.second = face;
    }
  std::vector<Eigen::Vector3i> open;
  for (const auto& [key, entry] : faces) {
    EXPECT_LE(entry.first, 2);
    if (entry.first == 1) open.push_back(entry.second);
  }
  Triangles triangles(3, static_cast<Eigen::Index>(open.size()));
  for (std::size_t i = 0; i < open.size(); ++i)
    triangles.col(static_cast<Eigen::Index>(i)) = open[i];
  return triangles;
}

/// Directed edges without their reverse: 0 for a closed, consistently oriented surface. Directed
/// edges that occur twice count too.
inline int unmatched_edges(const Triangles& triangles) {
  std::set<std::pair<int, int>> edges;
  int bad = 0;
  for (Eigen::Index i = 0; i < triangles.cols(); ++i)
    for (int k = 0; k < 3; ++k)
      if (!edges.emplace(triangles(k, i), triangles((k + 1) % 3, i)).second) ++bad;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) ++bad;
  return bad;
}

/// Signed distance to a surface, > 0 on the side of its normals.
class SurfaceDistance {
 public:
  SurfaceDistance(const Positions& X, const Triangles& triangles) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (Eigen::Index i = 0; i < X.cols(); ++i) points->InsertNextPoint(X.col(i).data());
    vtkNew<vtkCellArray> polys;
    for (Eigen::Index i = 0; i < triangles.cols(); ++i) {
      const std::array<vtkIdType, 3> cell = {triangles(0, i), triangles(1, i), triangles(2, i)};
      polys->InsertNextCell(3, cell.data());
    }
    surface_->SetPoints(points);
    surface_->SetPolys(polys);
    distance_->SetInput(surface_);
  }
  double operator()(const Vec3& p) {
    Vec3 q = p;
    return distance_->EvaluateFunction(q.data());
  }

 private:
  vtkNew<vtkPolyData> surface_;
  vtkNew<vtkImplicitPolyDataDistance> distance_;
};

inline std::pair<double, double> dihedral_range_deg(const Mesh& mesh) {
  double least = 180, largest = 0;
  for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) {
    std::array<Vec3, 4> p, n;
    for (int a = 0; a < 4; ++a) p[static_cast<std::size_t>(a)] = mesh.X_mm.col(mesh.tets(a, e));
    for (std::size_t a = 0; a < 4; ++a) {
      const Vec3 &i = p[(a + 1) % 4], &j = p[(a + 2) % 4], &k = p[(a + 3) % 4];
      n[a] = (j - i).cross(k - i).normalized();
      if (n[a].dot(p[a] - i) < 0) n[a] = -n[a];
    }
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b) {
        const double angle = 180 - std::acos(std::clamp(n[a].dot(n[b]), -1.0, 1.0)) / kDegree;
        least = std::min(least, angle);
        largest = std::max(largest, angle);
      }
  }
  return {least, largest};
}

}  // namespace articular::anatomy
