#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/mesh/mesh_io.hpp"

namespace articular::sim {

/// Kinds of cells as VTK's files number them.
namespace vtk_cell {
inline constexpr int kEmpty = 0, kVertex = 1, kPolyVertex = 2, kLine = 3, kPolyLine = 4,
                     kTriangle = 5, kTriangleStrip = 6, kPolygon = 7, kQuad = 9, kTetrahedron = 10;
}

/// Takes tetrahedra and triangles out of a file's cells; polygons and strips become triangles.
class CellCollector {
 public:
  /// @param file  for messages
  explicit CellCollector(std::string file) : file_(std::move(file)) {}

  /// @param nodes  `count` of them
  /// @throws InputError for a cell that is neither tissue nor surface, and for numbers that are no
  ///         node's
  void add(int type, std::int64_t count, const std::int64_t* nodes);
  void put_into(MeshData& mesh) const;

 private:
  int to_index(std::int64_t node) const;
  void add_triangle(std::int64_t a, std::int64_t b, std::int64_t c);

  std::string file_;
  std::vector<int> tets_, triangles_;
};

}  // namespace articular::sim
