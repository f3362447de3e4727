#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <cstdint>
#include <vector>

#include "sim/mesh/cell_collector.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/vtk_files.hpp"

namespace articular::sim {
namespace {

static_assert(vtk_cell::kTetrahedron == VTK_TETRA && vtk_cell::kQuad == VTK_QUAD &&
              vtk_cell::kPolygon == VTK_POLYGON && vtk_cell::kTriangle == VTK_TRIANGLE &&
              vtk_cell::kTriangleStrip == VTK_TRIANGLE_STRIP &&
              vtk_cell::kPolyLine == VTK_POLY_LINE && sizeof(vtkIdType) == sizeof(std::int64_t));

void add_cell(int type, vtkIdType e, vtkCellArray& from, CellCollector& cells) {
  vtkIdType count = 0;
  const vtkIdType* nodes = nullptr;
  from.GetCellAtId(e, count, nodes);
  const std::vector<std::int64_t> numbers(nodes, nodes + count);
  cells.add(type, count, numbers.data());
}

void add_all(int type, vtkCellArray* from, CellCollector& cells) {
  if (from == nullptr) return;
  for (vtkIdType e = 0; e < from->GetNumberOfCells(); ++e) add_cell(type, e, *from, cells);
}

/// Cell arrays with three components, of the tetrahedra alone.
std::vector<std::pair<std::string, Eigen::Matrix3Xd>> tetrahedra_vectors(
    vtkUnstructuredGrid& grid) {
  std::vector<vtkIdType> tets;
  for (vtkIdType e = 0; e < grid.GetNumberOfCells(); ++e)
    if (grid.GetCellType(e) == VTK_TETRA) tets.push_back(e);
  std::vector<std::pair<std::string, Eigen::Matrix3Xd>> vectors;
  for (int a = 0; a < grid.GetCellData()->GetNumberOfArrays(); ++a) {
    vtkDataArray* const array = grid.GetCellData()->GetArray(a);  // null for texts
    if (array == nullptr || array->GetNumberOfComponents() != 3 || array->GetName() == nullptr)
      continue;
    Eigen::Matrix3Xd values(3, static_cast<Eigen::Index>(tets.size()));
    for (std::size_t e = 0; e < tets.size(); ++e)
      array->GetTuple(tets[e], values.col(static_cast<Eigen::Index>(e)).data());
    vectors.emplace_back(array->GetName(), std::move(values));
  }
  return vectors;
}

}  // namespace

MeshData read_with_vtk(const std::filesystem::path& file) {
  const vtkSmartPointer<vtkPointSet> set = read_vtk_file(file);
  CellCollector cells(file.string());
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(set)) {
    for (vtkIdType e = 0; e < grid->GetNumberOfCells(); ++e)
      add_cell(grid->GetCellType(e), e, *grid->GetCells(), cells);
  } else if (auto* const surface = vtkPolyData::SafeDownCast(set)) {
    add_all(VTK_POLYGON, surface->GetPolys(), cells);
    add_all(VTK_TRIANGLE_STRIP, surface->GetStrips(), cells);
  }
  MeshData mesh;
  cells.put_into(mesh);
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(set))
    mesh.cell_vectors = tetrahedra_vectors(*grid);
  mesh.X.resize(3, set->GetNumberOfPoints());
  for (vtkIdType a = 0; a < set->GetNumberOfPoints(); ++a) set->GetPoint(a, mesh.X.col(a).data());
  return mesh;
}

}  // namespace articular::sim
