#include "sim/mesh/cell_collector.hpp"

#include <limits>

#include "sim/base/error.hpp"

namespace articular::sim {

void CellCollector::add(int type, std::int64_t count, const std::int64_t* nodes) {
  switch (type) {
    case vtk_cell::kEmpty:
    case vtk_cell::kVertex:
    case vtk_cell::kPolyVertex:
    case vtk_cell::kLine:
    case vtk_cell::kPolyLine:
      return;  // no tissue and no surface
    case vtk_cell::kTetrahedron:
      if (count != 4) break;
      for (std::int64_t a = 0; a < 4; ++a) tets_.push_back(to_index(nodes[a]));
      return;
    case vtk_cell::kTriangle:
    case vtk_cell::kQuad:
    case vtk_cell::kPolygon:
      for (std::int64_t a = 2; a < count; ++a)
        add_triangle(nodes[0], nodes[a - 1], nodes[a]);  // a fan from the first corner
      return;
    case vtk_cell::kTriangleStrip:
      for (std::int64_t a = 2; a < count; ++a)  // every second triangle is turned over
        if (a % 2 == 0)
          add_triangle(nodes[a - 2], nodes[a - 1], nodes[a]);
        else
          add_triangle(nodes[a - 2], nodes[a], nodes[a - 1]);
      return;
    default:
      break;
  }
  throw InputError({file_}, "holds a cell of VTK's type " + std::to_string(type) + " with " +
                                std::to_string(count) +
                                " points; expected linear tetrahedra, triangles or polygons");
}

void CellCollector::put_into(MeshData& mesh) const {
  mesh.tets =
      Eigen::Map<const Tetrahedra>(tets_.data(), 4, static_cast<Eigen::Index>(tets_.size() / 4));
  mesh.triangles = Eigen::Map<const Triangles>(triangles_.data(), 3,
                                               static_cast<Eigen::Index>(triangles_.size() / 3));
}

int CellCollector::to_index(std::int64_t node) const {
  if (node < 0 || node > std::numeric_limits<int>::max())
    throw InputError({file_}, "a cell refers to point " + std::to_string(node));
  return static_cast<int>(node);
}

void CellCollector::add_triangle(std::int64_t a, std::int64_t b, std::int64_t c) {
  triangles_.insert(triangles_.end(), {to_index(a), to_index(b), to_index(c)});
}

}  // namespace articular::sim
