#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include "sim/mesh_io.hpp"

namespace articular::sim {
namespace {

/// VTK merges points by absolute tolerances: it works in millimetres.
constexpr double kMillimetre = 1e-3;

vtkNew<vtkPolyData> to_vtk(const MeshData& surface) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < surface.X.cols(); ++i) {
    const Eigen::Vector3d x = surface.X.col(i) / kMillimetre;
    points->InsertNextPoint(x.data());
  }
  vtkNew<vtkCellArray> cells;
  for (Eigen::Index f = 0; f < surface.triangles.cols(); ++f) {
    cells->InsertNextCell(3);
    for (const int node : surface.triangles.col(f)) cells->InsertCellPoint(node);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

MeshData from_vtk(vtkPolyData& data) {
  MeshData result;
  result.X.resize(3, data.GetNumberOfPoints());
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
    result.X.col(i) = kMillimetre * Eigen::Map<const Eigen::Vector3d>(data.GetPoint(i));
  result.triangles.resize(3, data.GetNumberOfCells());
  vtkNew<vtkIdList> nodes;
  for (vtkIdType f = 0; f < data.GetNumberOfCells(); ++f) {
    data.GetCellPoints(f, nodes);
    for (int k = 0; k < 3; ++k) result.triangles(k, f) = static_cast<int>(nodes->GetId(k));
  }
  return result;
}

}  // namespace

MeshData simplified(const MeshData& surface, int faces) {
  if (faces >= surface.triangles.cols()) return surface;
  const auto input = to_vtk(surface);
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputData(input);
  decimation->SetTargetReduction(1 - static_cast<double>(faces) /
                                         static_cast<double>(surface.triangles.cols()));
  decimation->VolumePreservationOn();
  decimation->Update();
  return from_vtk(*decimation->GetOutput());
}

}  // namespace articular::sim
