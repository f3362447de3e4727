#include "sim/mesh/solid_cells.hpp"

#include <algorithm>

namespace articular::sim {
namespace {

/// Corners of each face, counterclockwise as seen from outside.
using Faces = std::vector<std::vector<std::size_t>>;

const Faces& faces_of(CellShape solid) {
  static const Faces kPyramid = {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  static const Faces kWedge = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  static const Faces kHexahedron = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                    {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  if (solid == CellShape::Pyramid) return kPyramid;
  return solid == CellShape::Wedge ? kWedge : kHexahedron;
}

bool has_node_twice(const std::array<int, 4>& tet) {
  for (std::size_t a = 1; a < 4; ++a)
    if (std::find(tet.begin(), tet.begin() + a, tet[a]) != tet.begin() + a) return true;
  return false;
}

}  // namespace

int num_corners(CellShape shape) {
  constexpr int kCorners[] = {1, 2, 3, 4, 4, 5, 6, 8};
  return kCorners[static_cast<int>(shape)];
}

std::vector<std::array<int, 3>> triangles_of(std::span<const int> nodes) {
  const auto smallest =
      static_cast<std::size_t>(std::min_element(nodes.begin(), nodes.end()) - nodes.begin());
  const auto node = [&](std::size_t k) { return nodes[(smallest + k) % nodes.size()]; };
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t k = 2; k < nodes.size(); ++k)
    triangles.push_back({node(0), node(k - 1), node(k)});
  return triangles;
}

std::vector<std::array<int, 4>> tetrahedra_of(CellShape solid, std::span<const int> nodes) {
  if (solid == CellShape::Tetrahedron) return {{nodes[0], nodes[1], nodes[2], nodes[3]}};
  const int from = *std::min_element(nodes.begin(), nodes.end());
  std::vector<std::array<int, 4>> tets;
  for (const std::vector<std::size_t>& corners : faces_of(solid)) {
    std::vector<int> face;
    for (const std::size_t corner : corners) face.push_back(nodes[corner]);
    if (std::find(face.begin(), face.end(), from) != face.end()) continue;
    for (const auto& [a, b, c] : triangles_of(face)) {
      const std::array<int, 4> tet{from, a, b, c};
      if (!has_node_twice(tet)) tets.push_back(tet);
    }
  }
  return tets;
}

}  // namespace articular::sim
