#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkSmartPointer.h>

#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/vtk_files.hpp"

namespace articular::sim {
namespace {

/// VTK merges points by absolute tolerances: it works in millimetres.
constexpr double kMillimetre = 1e-3;

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
  const auto input = make_surface(surface.X, kMillimetre, surface.triangles);
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputData(input);
  decimation->SetTargetReduction(1 - static_cast<double>(faces) /
                                         static_cast<double>(surface.triangles.cols()));
  decimation->VolumePreservationOn();
  decimation->Update();
  return from_vtk(*decimation->GetOutput());
}

}  // namespace articular::sim
