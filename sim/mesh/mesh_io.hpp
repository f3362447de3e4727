#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::sim {

/// A named part of a mesh: of elements, of faces, of nodes, or of several of these.
struct MeshSet {
  std::string name;
  std::vector<int> nodes;  // ascending; where the file lists none, those of the faces or elements
  std::vector<int> tets;   // columns of MeshData::tets
  std::vector<std::array<int, 3>> faces;  // nodes of each
};

/// What a mesh file holds: tetrahedra (tissue), triangles (bone surfaces), or both.
struct MeshData {
  Positions X;          // [unit of the file * unit]
  Tetrahedra tets;      // as in the file, 4 x 0 if none
  Triangles triangles;  // surface triangles of the file, polygons split; 3 x 0 if none
  /// Cell arrays with three components by their names, one column a tetrahedron (.vtu, .vtk).
  std::vector<std::pair<std::string, Eigen::Matrix3Xd>> cell_vectors{};
  std::vector<MeshSet> sets{};  // where the format has them; of VTK files by add_set_of_points()
};

/// Reads a mesh by the file's ending: .vtu, .vtp, .vtk, .stl, .obj, .ply; with named sets Gmsh .msh
/// (2.2 and 4.1, text or binary), Abaqus .inp, FEBio .feb, Nastran .bdf and .nas, Medit .mesh,
/// TetGen .ele and .node (with the files of the same name beside it). Those with sets may have
/// pyramids, wedges and hexahedra, which become tetrahedra (tetrahedra_of()). Nodes that no cell
/// uses are dropped; coincident vertices of .stl are merged. Positions are in double precision, but
/// for binary .stl, which has single.
/// @param unit   metres per unit of the file
/// @param parts  if not empty: only the elements of these sets, or if they have none, their faces
/// @throws InputError naming the file (and line, where the format is text) when it is missing, not
///         readable as its format, empty, holds cells that are not of first order, or a position
///         that is not finite or beyond 1e18 m, an element twice, or a node twice in an element; or
///         has no such part
MeshData read_mesh(const std::filesystem::path& file, double unit,
                   const std::vector<std::string>& parts = {});

/// The endings of files that may hold tetrahedra, as messages list them.
inline constexpr const char* kTissueEndings =
    ".vtu, .vtk, .msh, .inp, .feb, .bdf, .nas, .mesh, .ele, .node";

/// Writes tetrahedra (and triangles, if both) with cell arrays as .vtu, or triangles alone as .vtp,
/// with sets of nodes alone as point arrays: binary, compressed, whole or not at all.
/// @throws SystemError when it can't be written, InputError when the file's ending is another
void write_mesh(const std::filesystem::path& file, const MeshData& mesh, double unit);

/// A surface with about `faces` triangles in place of more: quadric decimation, which leaves out
/// what is flat first. Tetrahedra are dropped.
MeshData simplified(const MeshData& surface, int faces);

}  // namespace articular::sim
