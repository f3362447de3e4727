#include "tests/fem/support/delaunay_mesh.hpp"

#include <vtkCellArray.h>
#include <vtkDelaunay3D.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fem/mesh/tetrahedron.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem {
namespace {

constexpr double kFlat = 1e-6;  // [-] of the mean volume: four nodes of one face of the shape
constexpr double kOnCubePlane = 1e-9;  // [-] of the unit cube
constexpr double kMost = 0.25;         // of a cell, that a node moves
constexpr int kMostRounds = 2000;
constexpr double kSmallestDihedral = 10, kLargestDihedral = 160;  // [degrees]
constexpr double kRoundOff = 1e-9;  // [-] of volumes and circumspheres

/// The dihedral angles of the tetrahedron x, from normals that point outward.
std::array<double, 2> dihedral_range(const Mat34& x) {
  std::array<Vec3, 4> normal;
  for (int a = 0; a < 4; ++a) {
    const Vec3 p = x.col((a + 1) % 4), q = x.col((a + 2) % 4), r = x.col((a + 3) % 4);
    normal[static_cast<std::size_t>(a)] = (q - p).cross(r - p).normalized();
    if (normal[static_cast<std::size_t>(a)].dot(x.col(a) - p) > 0)
      normal[static_cast<std::size_t>(a)] *= -1;
  }
  std::array<double, 2> range{180, 0};
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) {
      const double cosine = std::clamp(-normal[a].dot(normal[b]), -1.0, 1.0);
      const double angle = std::acos(cosine) * 180 / std::numbers::pi;
      range = {std::min(range[0], angle), std::max(range[1], angle)};
    }
  }
  return range;
}

Mat34 corners(const Positions& X, const Eigen::Vector4i& tet) {
  Mat34 x;
  for (int a = 0; a < 4; ++a) x.col(a) = X.col(tet[a]);
  return x;
}

bool is_sliver(const std::array<double, 2>& dihedral) {
  return dihedral[0] < kSmallestDihedral || dihedral[1] > kLargestDihedral;
}

/// It warns of what is flat, which is looked after here: quality_of() judges the result.
class QuietVtk {
 public:
  QuietVtk() : before_(vtkObject::GetGlobalWarningDisplay()) {
    vtkObject::SetGlobalWarningDisplay(0);
  }
  QuietVtk(const QuietVtk&) = delete;
  QuietVtk& operator=(const QuietVtk&) = delete;
  ~QuietVtk() { vtkObject::SetGlobalWarningDisplay(before_); }

 private:
  int before_;
};

/// 1 − d²/r² of the node nearest to the centre of the circumsphere of x; not positive: none inside.
double intrusion(const Positions& X, const Mat34& x) {
  const Mat3 edges = edge_matrix(x);
  const Vec3 half_squares = edges.colwise().squaredNorm().transpose() / 2;
  const Vec3 to_centre = edges.transpose().inverse() * half_squares;
  const Vec3 centre = x.col(0) + to_centre;
  return 1 - (X.colwise() - centre).colwise().squaredNorm().minCoeff() / to_centre.squaredNorm();
}

/// Positive tetrahedra; what is flat between nodes of one face of the shape is left out.
Tetrahedra delaunay(const Positions& X) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& node : X.colwise()) points->InsertNextPoint(node.x(), node.y(), node.z());
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkDelaunay3D> filter;
  filter->SetInputData(cloud);
  filter->SetTolerance(0);
  const QuietVtk quiet;
  filter->Update();
  vtkUnstructuredGrid& grid = *filter->GetOutput();
  if (grid.GetNumberOfPoints() != X.cols()) throw std::runtime_error("Delaunay has lost nodes");

  const Vec3 size = X.rowwise().maxCoeff() - X.rowwise().minCoeff();
  const double flat = kFlat * size.prod() / static_cast<double>(grid.GetNumberOfCells());
  std::vector<Eigen::Vector4i> kept;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    grid.GetCellPoints(cell, ids);
    Eigen::Vector4i tet;
    for (int a = 0; a < 4; ++a) tet[a] = static_cast<int>(ids->GetId(a));
    const double volume = edge_matrix(corners(X, tet)).determinant() / 6;
    if (std::abs(volume) < flat) continue;
    if (volume < 0) std::swap(tet[2], tet[3]);
    kept.push_back(tet);
  }
  Tetrahedra tets(4, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t e = 0; e < kept.size(); ++e) tets.col(static_cast<Eigen::Index>(e)) = kept[e];
  return tets;
}

/// The grid whose nodes move.
class MovedGrid {
 public:
  MovedGrid(const std::array<int, 3>& cells, const std::function<Vec3(const Vec3&)>& map)
      : cells_(cells), map_(map), grid_(box_mesh(cells, Vec3::Ones()).X), X_(3, grid_.cols()) {
    for (int a = 0; a < grid_.cols(); ++a) move(a);
  }

  void move(int node) {
    Vec3 at = grid_.col(node);
    for (int i = 0; i < 3; ++i) {
      if (can_move(node, i))
        at[i] += random_.uniform(-kMost, kMost) / cells_[static_cast<std::size_t>(i)];
    }
    X_.col(node) = map_(at);
  }

  /// One of the four at random, that can move.
  void move_one_of(const Eigen::Vector4i& tet) {
    for (;;) {
      const int node = tet[static_cast<int>(random_.uniform(0, 4))];
      if (!can_move(node, 0) && !can_move(node, 1) && !can_move(node, 2)) continue;
      return move(node);
    }
  }

  const Positions& X() const { return X_; }

 private:
  bool can_move(int node, int axis) const {
    const double at = grid_(axis, node);
    return at > kOnCubePlane && at < 1 - kOnCubePlane && std::abs(at - 0.5) > kOnCubePlane;
  }

  std::array<int, 3> cells_;
  std::function<Vec3(const Vec3&)> map_;
  Positions grid_, X_;
  Random random_;
};

}  // namespace

MeshQuality quality_of(const TetMesh& mesh) {
  MeshQuality quality;
  for (const auto& tet : mesh.tets.colwise()) {
    const Mat34 x = corners(mesh.X, tet);
    const std::array<double, 2> dihedral = dihedral_range(x);
    quality.volume += edge_matrix(x).determinant() / 6;
    quality.smallest_dihedral = std::min(quality.smallest_dihedral, dihedral[0]);
    quality.largest_dihedral = std::max(quality.largest_dihedral, dihedral[1]);
    quality.deepest_intrusion = std::max(quality.deepest_intrusion, intrusion(mesh.X, x));
  }
  return quality;
}

TetMesh delaunay_mesh(const std::array<int, 3>& cells, const std::function<Vec3(const Vec3&)>& map,
                      double volume) {
  MovedGrid grid(cells, map);
  for (int round = 0; round < kMostRounds; ++round) {
    TetMesh mesh{grid.X(), delaunay(grid.X())};
    bool slivers = false;
    for (const auto& tet : mesh.tets.colwise()) {
      if (!is_sliver(dihedral_range(corners(mesh.X, tet)))) continue;
      grid.move_one_of(tet);
      slivers = true;
    }
    if (slivers) continue;
    const MeshQuality quality = quality_of(mesh);
    if (std::abs(quality.volume / volume - 1) > kRoundOff || quality.deepest_intrusion > kRoundOff)
      throw std::runtime_error("Delaunay's mesh is not sound");
    return mesh;
  }
  throw std::runtime_error("slivers remain in Delaunay's mesh");
}

LoadedBody delaunay_cook_membrane(int n) {
  const double volume = 48 * (44 + 16) / 2.0 * (48.0 / n);
  return cook_membrane(delaunay_mesh(
      {n, n, 1}, [n](const Vec3& unit) { return cook_point(n, unit); }, volume));
}

LoadedBody delaunay_block_compression(int n) {
  return block_compression(delaunay_mesh(
      {n, n, n}, [](const Vec3& unit) { return unit; }, 1));
}

}  // namespace articular::fem
