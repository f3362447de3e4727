#include "tools/anatomy/anatomy_solids.hpp"

#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace articular::anatomy {
namespace {

Vec3 position(const Knot& k) { return {k.x, k.y, k.z}; }

/// Barycentric coordinates of the point of triangle abc that is nearest to p.
/// [Ericson 2005, Real-Time Collision Detection, 5.1.5], written with the Voronoi regions in its
/// order.
Vec3 nearest_barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const double d1 = ab.dot(p - a), d2 = ac.dot(p - a);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = ab.dot(p - b), d4 = ac.dot(p - b);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = ab.dot(p - c), d6 = ac.dot(p - c);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

double distance(const ThickTriangle& t, const Vec3& p) {
  const Vec3 a = position(t.a), b = position(t.b), c = position(t.c);
  const Vec3 w = nearest_barycentric(p, a, b, c);
  return (p - (w.x() * a + w.y() * b + w.z() * c)).norm() -
         (w.x() * t.a.r + w.y() * t.b.r + w.z() * t.c.r);
}

/// Values on a grid of points.
struct Grid {
  Vec3 low;
  double h;
  Eigen::Vector3i points;
  std::vector<double> values{};  // x fastest

  double& at(int i, int j, int k) {
    const auto row = static_cast<std::size_t>(j) +
                     static_cast<std::size_t>(points.y()) * static_cast<std::size_t>(k);
    return values[static_cast<std::size_t>(i) + static_cast<std::size_t>(points.x()) * row];
  }
};

/// From the point `first` of each row on; the others are left zero.
void sample(const Distance& distance, int first, Grid& grid) {
  grid.values.assign(static_cast<std::size_t>(grid.points.cast<long>().prod()), 0.0);
  for (int k = 0; k < grid.points.z(); ++k)
    for (int j = 0; j < grid.points.y(); ++j)
      for (int i = first; i < grid.points.x(); ++i)
        grid.at(i, j, k) = distance(grid.low + grid.h * Vec3(i, j, k));
}

int points_between(double low, double high, double h) {
  return static_cast<int>(std::ceil((high - low) / h)) + 1;
}

Mesh zero_level(Grid& grid) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(grid.points.data());
  image->SetSpacing(grid.h, grid.h, grid.h);
  image->SetOrigin(grid.low.data());
  image->AllocateScalars(VTK_DOUBLE, 1);
  std::copy(grid.values.begin(), grid.values.end(),
            static_cast<double*>(image->GetScalarPointer()));
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(image);
  edges->SetValue(0, 0.0);
  edges->ComputeNormalsOff();
  edges->ComputeScalarsOff();
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;
  smooth->SetInputConnection(edges->GetOutputPort());
  smooth->SetNumberOfIterations(15);
  smooth->SetPassBand(0.25);
  smooth->NormalizeCoordinatesOn();
  smooth->Update();
  vtkPolyData* surface = smooth->GetOutput();

  Mesh mesh;
  mesh.X_mm.resize(3, surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    surface->GetPoint(i, mesh.X_mm.col(i).data());
  mesh.triangles.resize(3, surface->GetNumberOfPolys());
  vtkNew<vtkIdList> cell;
  vtkCellArray* polys = surface->GetPolys();
  for (vtkIdType i = 0; i < surface->GetNumberOfPolys(); ++i) {
    polys->GetCellAtId(i, cell);
    for (int c = 0; c < 3; ++c) mesh.triangles(c, i) = static_cast<int>(cell->GetId(c));
  }
  if (volume_and_center(mesh).first < 0) mesh.triangles.row(1).swap(mesh.triangles.row(2));
  return mesh;
}

}  // namespace

ThickTriangle::ThickTriangle(const Knot& a_, const Knot& b_, const Knot& c_) : a(a_), b(b_), c(c_) {
  center = (position(a) + position(b) + position(c)) / 3;
  for (const Knot& k : {a, b, c}) reach = std::max(reach, (position(k) - center).norm() + k.r);
}

double smooth_min(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width / 4;
}

double distance(const Sheet& sheet, const Vec3& p) {
  double least = kFar;
  for (const ThickTriangle& t : sheet)
    if ((p - t.center).norm() - t.reach < least) least = std::min(least, distance(t, p));
  return least;
}

void add_strip(Sheet& sheet, const std::vector<Knot>& lower, const std::vector<Knot>& upper) {
  for (std::size_t i = 0; i + 1 < lower.size(); ++i) {
    sheet.emplace_back(lower[i], lower[i + 1], upper[i + 1]);
    sheet.emplace_back(lower[i], upper[i + 1], upper[i]);
  }
}

void add_rods(Sheet& sheet, const std::vector<Knot>& chain) {
  for (std::size_t i = 0; i + 1 < chain.size(); ++i)
    sheet.push_back({chain[i], chain[i + 1], chain[i + 1]});
}

std::vector<Knot> smoothed(const std::vector<Knot>& knots, int n) {
  std::vector<Knot> out;
  const auto vec = [](const Knot& k) { return Eigen::Vector4d(k.x, k.y, k.z, k.r); };
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const Eigen::Vector4d p1 = vec(knots[i]), p2 = vec(knots[i + 1]);
    const Eigen::Vector4d p0 = i > 0             ? vec(knots[i - 1])
                               : knots[0].x == 0 ? Eigen::Vector4d(-p2.x(), p2.y(), p2.z(), p2.w())
                                                 : Eigen::Vector4d(2 * p1 - p2);
    const Eigen::Vector4d p3 =
        i + 2 < knots.size() ? vec(knots[i + 2]) : Eigen::Vector4d(2 * p2 - p1);
    const Eigen::Vector4d m1 = (p2 - p0) / 2, m2 = (p3 - p1) / 2;
    for (int j = 0; j < n + (i + 2 == knots.size() ? 1 : 0); ++j) {
      const double t = static_cast<double>(j) / n;
      const Eigen::Vector4d q = (2 * t * t * t - 3 * t * t + 1) * p1 +
                                (t * t * t - 2 * t * t + t) * m1 +
                                (3 * t * t - 2 * t * t * t) * p2 + (t * t * t - t * t) * m2;
      out.push_back({q.x(), q.y(), q.z(), q.w()});
    }
  }
  return out;
}

Mesh contour_even(const Distance& distance, const Vec3& low, const Vec3& high, double h) {
  const int half = static_cast<int>(std::ceil(high.x() / h));
  Grid grid{
      {-h * half, low.y(), low.z()},
      h,
      {2 * half + 1, points_between(low.y(), high.y(), h), points_between(low.z(), high.z(), h)}};
  sample(distance, half, grid);
  for (int k = 0; k < grid.points.z(); ++k)
    for (int j = 0; j < grid.points.y(); ++j)
      for (int i = 0; i < half; ++i) grid.at(i, j, k) = grid.at(2 * half - i, j, k);
  return zero_level(grid);
}

Mesh contour(const Distance& distance, const Vec3& low, const Vec3& high, double h) {
  Grid grid{low,
            h,
            {points_between(low.x(), high.x(), h), points_between(low.y(), high.y(), h),
             points_between(low.z(), high.z(), h)}};
  sample(distance, 0, grid);
  return zero_level(grid);
}

Mesh part_of(const Mesh& surface, const std::function<bool(const Vec3&, const Vec3&)>& keep) {
  std::vector<int> number(static_cast<std::size_t>(surface.X_mm.cols()), -1);
  std::vector<Vec3> nodes;
  std::vector<Eigen::Vector3i> faces;
  for (Eigen::Vector3i face : surface.triangles.colwise()) {
    const Vec3 a = surface.X_mm.col(face(0)), b = surface.X_mm.col(face(1)),
               c = surface.X_mm.col(face(2));
    if (!keep(Vec3((a + b + c) / 3), Vec3((b - a).cross(c - a).normalized()))) continue;
    for (int& node : face) {
      int& kept = number[static_cast<std::size_t>(node)];
      if (kept < 0) {
        kept = static_cast<int>(nodes.size());
        nodes.push_back(surface.X_mm.col(node));
      }
      node = kept;
    }
    faces.push_back(face);
  }
  Mesh part;
  part.X_mm.resize(3, static_cast<Eigen::Index>(nodes.size()));
  part.triangles.resize(3, static_cast<Eigen::Index>(faces.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    part.X_mm.col(static_cast<Eigen::Index>(i)) = nodes[i];
  for (std::size_t i = 0; i < faces.size(); ++i)
    part.triangles.col(static_cast<Eigen::Index>(i)) = faces[i];
  return part;
}

std::pair<double, Vec3> volume_and_center(const Mesh& surface) {
  double volume = 0;
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index i = 0; i < surface.triangles.cols(); ++i) {
    const Vec3 a = surface.X_mm.col(surface.triangles(0, i)),
               b = surface.X_mm.col(surface.triangles(1, i)),
               c = surface.X_mm.col(surface.triangles(2, i));
    const double v = a.cross(b).dot(c) / 6;
    volume += v;
    moment += v * (a + b + c) / 4;
  }
  return {volume, moment / volume};
}

}  // namespace articular::anatomy
