#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <limits>

#include "sim/base/error.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/vtk_files.hpp"

namespace articular::sim {
namespace {

class CellCollector {
 public:
  explicit CellCollector(std::string file) : file_(std::move(file)) {}

  void add(int type, vtkIdType count, const vtkIdType* nodes) {
    switch (type) {
      case VTK_EMPTY_CELL:
      case VTK_VERTEX:
      case VTK_POLY_VERTEX:
      case VTK_LINE:
      case VTK_POLY_LINE:
        return;  // no tissue and no surface
      case VTK_TETRA:
        if (count != 4) break;
        for (vtkIdType a = 0; a < 4; ++a) tets_.push_back(to_index(nodes[a]));
        return;
      case VTK_TRIANGLE:
      case VTK_QUAD:
      case VTK_POLYGON:
        for (vtkIdType a = 2; a < count; ++a)
          add_triangle(nodes[0], nodes[a - 1], nodes[a]);  // a fan from the first corner
        return;
      case VTK_TRIANGLE_STRIP:
        for (vtkIdType a = 2; a < count; ++a)  // every second triangle is turned over
          if (a % 2 == 0)
            add_triangle(nodes[a - 2], nodes[a - 1], nodes[a]);
          else
            add_triangle(nodes[a - 2], nodes[a], nodes[a - 1]);
        return;
      default:
        break;
    }
    throw InputError({file_}, std::string("holds a cell of type ") +
                                  vtkCellTypes::GetClassNameFromTypeId(type) +
                                  "; expected linear tetrahedra, triangles or polygons");
  }

  void add_all(int type, vtkCellArray* cells) {
    if (cells == nullptr) return;
    for (vtkIdType e = 0; e < cells->GetNumberOfCells(); ++e) {
      vtkIdType count = 0;
      const vtkIdType* nodes = nullptr;
      cells->GetCellAtId(e, count, nodes);
      add(type, count, nodes);
    }
  }

  void put_into(MeshData& mesh) const {
    mesh.tets =
        Eigen::Map<const Tetrahedra>(tets_.data(), 4, static_cast<Eigen::Index>(tets_.size() / 4));
    mesh.triangles = Eigen::Map<const Triangles>(triangles_.data(), 3,
                                                 static_cast<Eigen::Index>(triangles_.size() / 3));
  }

 private:
  int to_index(vtkIdType node) const {
    if (node < 0 || node > std::numeric_limits<int>::max())
      throw InputError({file_}, "a cell refers to point " + std::to_string(node));
    return static_cast<int>(node);
  }

  void add_triangle(vtkIdType a, vtkIdType b, vtkIdType c) {
    triangles_.insert(triangles_.end(), {to_index(a), to_index(b), to_index(c)});
  }

  std::string file_;
  std::vector<int> tets_, triangles_;
};

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
    for (vtkIdType e = 0; e < grid->GetNumberOfCells(); ++e) {
      vtkIdType count = 0;
      const vtkIdType* nodes = nullptr;
      grid->GetCells()->GetCellAtId(e, count, nodes);
      cells.add(grid->GetCellType(e), count, nodes);
    }
  } else if (auto* const surface = vtkPolyData::SafeDownCast(set)) {
    cells.add_all(VTK_POLYGON, surface->GetPolys());
    cells.add_all(VTK_TRIANGLE_STRIP, surface->GetStrips());
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
