#pragma once

#include <array>
#include <functional>

#include "tests/fem/support/loaded_body.hpp"

namespace articular::fem {

struct MeshQuality {
  double volume = 0;                                     // the sum
  double smallest_dihedral = 180, largest_dihedral = 0;  // angle between two faces [degrees]
  double deepest_intrusion = 0;  // 1 − d²/r² of the node that is deepest in a circumsphere
};
MeshQuality quality_of(const TetMesh& mesh);

/// Delaunay's mesh (vtkDelaunay3D) of the nodes of a grid, moved at random by up to a quarter of a
/// cell and mapped to a convex shape; nodes of a face stay in it, those at half the length of an
/// axis in that plane. Such meshes have slivers, here tetrahedra with an angle between two faces
/// outside 10 to 160 degrees. A node of each sliver is moved anew and the mesh made again, until
/// there is none: the result is Delaunay's mesh of its nodes throughout. The seed is fixed.
/// @param map     from the unit cube to the shape
/// @param volume  of the shape
/// @throws std::runtime_error where slivers remain, or the mesh does not fill the shape or has
///         nodes in a circumsphere
TetMesh delaunay_mesh(const std::array<int, 3>& cells, const std::function<Vec3(const Vec3&)>& map,
                      double volume);

/// The problems of loaded_body.hpp on such meshes, of n x n x 1 and n x n x n cells.
LoadedBody delaunay_cook_membrane(int n);
LoadedBody delaunay_block_compression(int n);

}  // namespace articular::fem
