#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/message_text.hpp"
#include "sim/mesh/mesh_io.hpp"

/// The readers behind read_mesh(), one a family of formats. Each returns the file's own unit and
/// all of its nodes, used or not; read_mesh() drops, checks and scales. All throw InputError.
namespace articular::sim {

/// Abaqus input deck: nodes, elements C3D4, C3D5, C3D6, C3D8 and shells or membranes of 3 and 4
/// nodes; *NSET, *ELSET and *SURFACE. Other keywords and elements without volume are skipped.
MeshData read_abaqus(const std::filesystem::path& file);

/// Gmsh .msh of version 2.2 or 4.1, text or binary. Sets are the physical groups, by name or, of
/// those without one, as "volume 1", "surface 2", "line 3", "point 4". Read here: Gmsh's own
/// library brings OpenCASCADE and 300 MB.
MeshData read_gmsh(const std::filesystem::path& file);

/// The mesh of a FEBio model, version 2.5, 3.0 or 4.0: parts (Elements), NodeSet, ElementSet and
/// Surface are sets; ElementData with three components are vectors of cells.
MeshData read_febio(const std::filesystem::path& file);

/// Nastran bulk data: GRID, CTETRA, CPYRAM, CPENTA, CHEXA, CTRIA3, CQUAD4, in small, large or free
/// fields. Properties are sets "volume 1" and "surface 2", SPC and SPC1 "spc 3".
MeshData read_nastran(const std::filesystem::path& file);

/// Medit .mesh in text. References other than 0 are sets "volume 1", "surface 2", "line 3", "point
/// 4".
MeshData read_medit(const std::filesystem::path& file);

/// TetGen: the .node, .ele and, if it is there, .face of one name. Attributes and markers other
/// than 0 are sets "volume 1", "surface 2", "point 3".
/// @param file  any of the three
MeshData read_tetgen(const std::filesystem::path& file);

/// Wavefront: `v` and `f`, polygons split as a fan from their first corner; the rest is skipped.
/// Read here and not by VTK, which keeps single precision only and splits vertices that have
/// several normals.
MeshData read_obj(const std::filesystem::path& file);

/// Stanford polygons: x, y, z of `vertex` and the lists of `face`, polygons split as above, in text
/// or binary of either byte order. Read here and not by VTK, which crashes on damaged files.
MeshData read_ply(const std::filesystem::path& file);

/// Legacy .vtk in text or binary, unstructured grids and polygonal data, with the vectors of cells.
/// Read here and not by VTK, which trusts what a file claims to hold.
MeshData read_legacy_vtk(const std::filesystem::path& file);

/// .vtu and .vtp, with the vectors of cells: see vtk_xml_file.hpp.
MeshData read_vtk_xml_mesh(const std::filesystem::path& file);

/// Stereolithography, text or binary (which has single precision). Corners at one place become one
/// node. Read here and not by VTK, which reads any bytes as triangles.
MeshData read_stl(const std::filesystem::path& file);

/// ".vtu" of "disc.VTU".
std::string lower_ending(const std::filesystem::path& file);

/// One finite number, nothing before or after it; empty if it is none.
std::optional<double> parse_number(std::string_view text);
std::optional<int> parse_integer(std::string_view text);
std::optional<std::int64_t> parse_long(std::string_view text);

}  // namespace articular::sim
