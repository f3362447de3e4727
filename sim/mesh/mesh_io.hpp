#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::sim {

/// What a mesh file holds: tetrahedra (tissue), triangles (bone surfaces), or both.
struct MeshData {
  Positions X;          // [unit of the file * unit]
  Tetrahedra tets;      // as in the file, 4 x 0 if none
  Triangles triangles;  // surface triangles of the file, polygons split; 3 x 0 if none
  /// Cell arrays with three components by their names, one column a tetrahedron (.vtu, .vtk).
  std::vector<std::pair<std::string, Eigen::Matrix3Xd>> cell_vectors{};
};

/// Reads .vtu, .vtp, .vtk, .stl, .obj, .ply or Abaqus .inp (*NODE, *ELEMENT TYPE=C3D4; others
/// skipped), by the file's ending. Nodes that no cell uses are dropped; coincident vertices of .stl
/// are merged. Positions are in double precision, but for binary .stl, which has single.
/// @param unit  metres per unit of the file
/// @throws InputError naming the file (and line, for .inp) when it is missing, not readable as its
///         format, empty, holds other volume cells than linear tetrahedra, or a position that is
///         not finite or beyond 1e18 m, an element twice, or a node twice in an element
MeshData read_mesh(const std::filesystem::path& file, double unit);

/// Writes tetrahedra (and triangles, if there are both) with their cell arrays as .vtu, or
/// triangles alone as .vtp: binary, compressed, whole or not at all (write beside, then rename).
/// @throws SystemError when it can't be written, InputError when the file's ending is another
void write_mesh(const std::filesystem::path& file, const MeshData& mesh, double unit);

/// A surface with about `faces` triangles in place of more: quadric decimation, which leaves out
/// what is flat first. Tetrahedra are dropped.
MeshData simplified(const MeshData& surface, int faces);

}  // namespace articular::sim
