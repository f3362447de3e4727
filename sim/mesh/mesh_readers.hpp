#pragma once

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

/// Abaqus input deck: nodes of every *NODE block, tetrahedra of every *ELEMENT block with
/// TYPE=C3D4. Node numbers may have gaps; other keywords and other elements are skipped.
MeshData read_abaqus(const std::filesystem::path& file);

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

}  // namespace articular::sim
