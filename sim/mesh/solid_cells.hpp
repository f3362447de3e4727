#pragma once

#include <array>
#include <span>
#include <vector>

namespace articular::sim {

/// Cells of meshes, with as many corners as num_corners() says. Their order is VTK's, which
/// Gmsh, Abaqus, Nastran, Medit and FEBio share: the lower face counterclockwise as seen from the
/// upper one (or the top), then the upper one.
enum class CellShape {
  Point,
  Line,
  Triangle,
  Quadrilateral,
  Tetrahedron,
  Pyramid,
  Wedge,
  Hexahedron
};

int num_corners(CellShape shape);

/// Whether it has a volume.
inline bool is_solid(CellShape shape) { return shape >= CellShape::Tetrahedron; }

/// Tetrahedra that fill a solid: lines are drawn from its smallest node to all faces that do not
/// have it, and a face of four nodes is cut through its own smallest node. So both solids at a face
/// cut it alike, and the tetrahedra conform [Dompierre 1999]. A solid with a node twice (a
/// hexahedron that stands for a wedge) leaves out the flat ones.
///
/// [Dompierre 1999] Dompierre, Labbé, Vallet, Camarero. How to subdivide pyramids, prisms and
/// hexahedra into tetrahedra. 8th International Meshing Roundtable.
std::vector<std::array<int, 4>> tetrahedra_of(CellShape solid, std::span<const int> nodes);

/// Triangles of a triangle or quadrilateral, cut as the faces of solids are.
std::vector<std::array<int, 3>> triangles_of(std::span<const int> nodes);

}  // namespace articular::sim
