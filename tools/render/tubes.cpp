#include "tools/render/tubes.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTriangleFilter.h>
#include <vtkTubeFilter.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "fem/base/types.hpp"
#include "tools/render/skin.hpp"

namespace articular::tools {
namespace {

constexpr const char* kRadius = "radius";
constexpr int kPointsAPath = 33;

/// The path with equal steps between its points, so that a muscle can have a belly.
Positions resampled(vtkPointSet& set, vtkIdList& nodes) {
  std::vector<Vec3> corners;
  std::vector<double> length;  // from the start to each corner
  for (vtkIdType a = 0; a < nodes.GetNumberOfIds(); ++a) {
    Vec3 p;
    set.GetPoint(nodes.GetId(a), p.data());
    const double step = corners.empty() ? 0 : (p - corners.back()).norm();
    if (!corners.empty() && step == 0) continue;
    length.push_back(corners.empty() ? 0 : length.back() + step);
    corners.push_back(p);
  }
  if (corners.size() < 2) return Positions(3, 0);
  Positions path(3, kPointsAPath);
  std::size_t segment = 1;
  for (int i = 0; i < kPointsAPath; ++i) {
    const double s = length.back() * i / (kPointsAPath - 1);
    while (segment + 1 < corners.size() && length[segment] < s) ++segment;
    const double part = (s - length[segment - 1]) / (length[segment] - length[segment - 1]);
    path.col(i) = corners[segment - 1] + part * (corners[segment] - corners[segment - 1]);
  }
  return path;
}

double value_of(vtkPointSet& set, const std::string& field, vtkIdType line) {
  vtkDataArray* const array = set.GetCellData()->GetArray(field.c_str());
  return array != nullptr ? array->GetComponent(line, 0) : 0;
}

}  // namespace

vtkSmartPointer<vtkPolyData> tubes_of(vtkPointSet& lines, LineKind kind, double radius,
                                      const std::string& field, double factor) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> paths;
  vtkNew<vtkDoubleArray> values, radii;
  values->SetName(kShown);
  radii->SetName(kRadius);
  vtkNew<vtkIdList> nodes;
  for (vtkIdType line = 0; line < lines.GetNumberOfCells(); ++line) {
    const bool is_muscle = value_of(lines, "kind", line) < 0.5;
    if (is_muscle != (kind == LineKind::Muscle)) continue;
    lines.GetCellPoints(line, nodes);
    const Positions path = resampled(lines, *nodes);
    if (path.cols() == 0) continue;
    paths->InsertNextCell(kPointsAPath);
    for (int i = 0; i < kPointsAPath; ++i) {
      paths->InsertCellPoint(points->InsertNextPoint(path.col(i).data()));
      const double belly = std::sin(std::numbers::pi * i / (kPointsAPath - 1));
      radii->InsertNextValue(radius * (is_muscle ? 0.4 + 0.6 * belly : 0.4));
      values->InsertNextValue(factor * value_of(lines, field, line));
    }
  }
  vtkNew<vtkPolyData> set;
  set->SetPoints(points);
  set->SetLines(paths);
  set->GetPointData()->AddArray(values);
  set->GetPointData()->SetScalars(radii);
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(set);
  tubes->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  tubes->SetNumberOfSides(20);
  tubes->CappingOn();
  vtkNew<vtkTriangleFilter> triangles;  // strips have no outlines
  triangles->SetInputConnection(tubes->GetOutputPort());
  if (paths->GetNumberOfCells() > 0) triangles->Update();
  return triangles->GetOutput();
}

}  // namespace articular::tools
