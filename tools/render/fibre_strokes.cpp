#include "tools/render/fibre_strokes.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "fem/base/types.hpp"

namespace articular::tools {

vtkSmartPointer<vtkPolyData> fibre_strokes(vtkPolyData& surface) {
  constexpr double kLength = 1.1;  // by the square root of the triangle's area
  auto strokes = vtkSmartPointer<vtkPolyData>::New();
  vtkDataArray* const directions = surface.GetCellData()->GetArray(kFibreDirection);
  if (directions == nullptr || directions->GetNumberOfComponents() != 3) return strokes;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; face < surface.GetNumberOfCells(); ++face) {
    surface.GetCellPoints(face, corners);
    if (corners->GetNumberOfIds() != 3) continue;
    std::array<Vec3, 3> p;
    Vec3 fibre;
    for (std::size_t a = 0; a < 3; ++a)
      surface.GetPoint(corners->GetId(static_cast<vtkIdType>(a)), p[a].data());
    directions->GetTuple(face, fibre.data());
    const Vec3 across = (p[1] - p[0]).cross(p[2] - p[0]);
    const double area = 0.5 * across.norm();
    if (!(area > 0)) continue;
    const Vec3 normal = across.normalized();
    const Vec3 half = 0.5 * kLength * std::sqrt(area) * (fibre - fibre.dot(normal) * normal);
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3;
    lines->InsertNextCell(2);
    for (const double side : {-1.0, 1.0})
      lines->InsertCellPoint(points->InsertNextPoint(Vec3(middle + side * half).data()));
  }
  strokes->SetPoints(points);
  strokes->SetLines(lines);
  return strokes;
}

}  // namespace articular::tools
