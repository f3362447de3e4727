#include "tools/mesh/mesh_quality.hpp"

#include <vtkCellArray.h>
#include <vtkCellLocator.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "collision/mesh/surface.hpp"

namespace articular::tools {
namespace {

double mean_edge(const TetMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (const auto& tet : mesh.tets.colwise())
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b) edges.insert(std::minmax({tet(a), tet(b)}));
  double sum = 0;
  for (const auto& [a, b] : edges) sum += (mesh.X.col(a) - mesh.X.col(b)).norm();
  return sum / static_cast<double>(edges.size());
}

int count_parts(const Eigen::Matrix4Xi& neighbours) {
  std::vector<bool> seen(static_cast<std::size_t>(neighbours.cols()), false);
  int parts = 0;
  for (int first = 0; first < neighbours.cols(); ++first) {
    if (seen[static_cast<std::size_t>(first)]) continue;
    ++parts;
    std::vector<int> front = {first};
    seen[static_cast<std::size_t>(first)] = true;
    while (!front.empty()) {
      const int tet = front.back();
      front.pop_back();
      for (const int next : neighbours.col(tet))
        if (next >= 0 && !seen[static_cast<std::size_t>(next)]) {
          seen[static_cast<std::size_t>(next)] = true;
          front.push_back(next);
        }
    }
  }
  return parts;
}

class SurfaceDistance {
 public:
  SurfaceDistance(const Positions& X, const Triangles& triangles) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const auto& x : X.colwise()) points->InsertNextPoint(x(0), x(1), x(2));
    vtkNew<vtkCellArray> cells;
    for (const auto& t : triangles.colwise()) {
      const std::array<vtkIdType, 3> cell = {t(0), t(1), t(2)};
      cells->InsertNextCell(3, cell.data());
    }
    surface_->SetPoints(points);
    surface_->SetPolys(cells);
    locator_->SetDataSet(surface_);
    locator_->BuildLocator();
  }

  double operator()(const Vec3& x) {
    Vec3 nearest;
    vtkIdType cell = 0;
    int part = 0;
    double squared = 0;
    locator_->FindClosestPoint(x.data(), nearest.data(), cell_, cell, part, squared);
    return std::sqrt(squared);
  }

 private:
  vtkNew<vtkPolyData> surface_;
  vtkNew<vtkCellLocator> locator_;
  vtkNew<vtkGenericCell> cell_;
};

double largest_distance(const TetMesh& mesh, const Triangles& faces, const Shell& shell) {
  SurfaceDistance to_shell(shell.X, shell.triangles), to_mesh(mesh.X, faces);
  double largest = 0;
  for (const auto& t : faces.colwise()) {
    for (int k = 0; k < 3; ++k) largest = std::max(largest, to_shell(mesh.X.col(t(k))));
    const Vec3 centre = (mesh.X.col(t(0)) + mesh.X.col(t(1)) + mesh.X.col(t(2))) / 3;
    largest = std::max(largest, to_shell(centre));
  }
  for (const auto& x : shell.X.colwise()) largest = std::max(largest, to_mesh(x));
  return largest;
}

}  // namespace

double least_dihedral_deg(const Positions& X, const Eigen::Ref<const Eigen::Vector4i>& tet) {
  std::array<Vec3, 4> p;
  for (int a = 0; a < 4; ++a) p[static_cast<std::size_t>(a)] = X.col(tet[a]);
  std::array<Vec3, 4> normal;  // of the face opposite each corner, inward
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec3 &i = p[(a + 1) % 4], &j = p[(a + 2) % 4], &k = p[(a + 3) % 4];
    normal[a] = (j - i).cross(k - i).normalized();
    if (normal[a].dot(p[a] - i) < 0) normal[a] = -normal[a];
  }
  double least = std::numbers::pi;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < a; ++b)
      least = std::min(least, std::acos(std::clamp(-normal[a].dot(normal[b]), -1.0, 1.0)));
  return least * 180 / std::numbers::pi;
}

MeshQuality mesh_quality(const TetMesh& mesh, const Shell& shell) {
  MeshQuality quality;
  std::vector<double> angles;
  for (const auto& tet : mesh.tets.colwise()) {
    std::array<Vec3, 4> p;
    for (int a = 0; a < 4; ++a) p[static_cast<std::size_t>(a)] = mesh.X.col(tet(a));
    angles.push_back(least_dihedral_deg(mesh.X, tet));
    quality.volume += (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6;
  }
  std::sort(angles.begin(), angles.end());
  constexpr double kSliver = 10;  // [deg]
  quality.least_dihedral_deg = angles.front();
  quality.median_dihedral_deg = angles[angles.size() / 2];
  quality.tets_below_10_deg =
      std::lower_bound(angles.begin(), angles.end(), kSliver) - angles.begin();
  quality.mean_edge = mean_edge(mesh);
  const collision::Surface surface =
      collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols()));
  const std::set<int> on_surface(surface.faces.data(), surface.faces.data() + surface.faces.size());
  quality.inner_nodes = mesh.X.cols() - static_cast<Eigen::Index>(on_surface.size());
  quality.parts = count_parts(surface.neighbours);
  quality.largest_distance = largest_distance(mesh, surface.faces, shell);
  return quality;
}

}  // namespace articular::tools
