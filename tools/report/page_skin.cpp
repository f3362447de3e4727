#include "tools/report/page_skin.hpp"

#include <vtkCellArray.h>
#include <vtkGeometryFilter.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkTriangleFilter.h>

#include <algorithm>

namespace articular::tools {
namespace {

vtkSmartPointer<vtkPolyData> triangles_of(vtkPointSet& set) {
  vtkNew<vtkGeometryFilter> boundary;
  boundary->SetInputData(&set);
  boundary->PassThroughPointIdsOn();
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(boundary->GetOutputPort());
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  triangles->Update();
  return triangles->GetOutput();
}

}  // namespace

PageSkin page_skin(vtkPointSet& set) {
  const auto surface = triangles_of(set);
  // Where the surface has other points than the part, it says which.
  auto* const original =
      vtkIdTypeArray::SafeDownCast(surface->GetPointData()->GetArray("vtkOriginalPointIds"));
  std::vector<vtkIdType> corners;
  vtkIdType count = 0;
  const vtkIdType* points = nullptr;
  for (surface->GetPolys()->InitTraversal(); surface->GetPolys()->GetNextCell(count, points) != 0;)
    for (vtkIdType k = 0; k < count; ++k)
      corners.push_back(original != nullptr ? original->GetValue(points[k]) : points[k]);

  PageSkin skin{corners, {}};
  std::sort(skin.nodes.begin(), skin.nodes.end());
  skin.nodes.erase(std::unique(skin.nodes.begin(), skin.nodes.end()), skin.nodes.end());
  skin.corners.reserve(corners.size());
  for (const vtkIdType node : corners)
    skin.corners.push_back(static_cast<std::uint32_t>(
        std::lower_bound(skin.nodes.begin(), skin.nodes.end(), node) - skin.nodes.begin()));
  return skin;
}

vtkSmartPointer<vtkPointSet> simplified_surface(vtkPointSet& surface, vtkIdType most_triangles) {
  const auto triangles = triangles_of(surface);
  const auto count = static_cast<double>(triangles->GetNumberOfPolys());
  vtkNew<vtkQuadricDecimation> simpler;
  simpler->SetInputData(triangles);
  simpler->SetTargetReduction(1 - static_cast<double>(most_triangles) / count);
  simpler->VolumePreservationOn();
  simpler->Update();
  return simpler->GetOutput();
}

Positions positions_at(vtkPointSet& set, const std::vector<vtkIdType>& nodes) {
  Positions x(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    set.GetPoint(nodes[i], x.col(static_cast<Eigen::Index>(i)).data());
  return x;
}

}  // namespace articular::tools
