#include "sim/mesh/mesh_io.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "sim/base/error.hpp"
#include "sim/mesh/mesh_defects.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/mesh_sets.hpp"

namespace articular::sim {
namespace {

struct Reader {
  std::string_view ending;
  MeshData (*read)(const std::filesystem::path& file);
};
constexpr Reader kReaders[] = {
    {".vtu", read_vtk_xml_mesh}, {".vtp", read_vtk_xml_mesh}, {".vtk", read_legacy_vtk},
    {".stl", read_stl},          {".obj", read_obj},          {".ply", read_ply},
    {".inp", read_abaqus},       {".msh", read_gmsh},         {".feb", read_febio},
    {".bdf", read_nastran},      {".nas", read_nastran},      {".mesh", read_medit},
    {".ele", read_tetgen},       {".node", read_tetgen}};

std::string known_endings() {
  std::string endings;
  for (const Reader& reader : kReaders)
    endings += (endings.empty() ? "" : ", ") + std::string(reader.ending);
  return endings;
}

/// Calls visit(index) for every node index of every cell.
template <class Visit>
void for_each_index(MeshData& mesh, Visit visit) {
  for (int& a : mesh.tets.reshaped()) visit(a);
  for (int& a : mesh.triangles.reshaped()) visit(a);
}

void check_indices(const std::string& file, MeshData& mesh) {
  const Eigen::Index num_nodes = mesh.X.cols();
  for_each_index(mesh, [&](int a) {
    if (a < 0 || a >= num_nodes)
      throw InputError({file}, "a cell refers to point " + std::to_string(a) + ", but there are " +
                                   std::to_string(num_nodes) + " points");
  });
}

/// Renumbers so that every node is used by a cell; the order of the nodes stays.
void drop_unused_nodes(MeshData& mesh) {
  std::vector<int> new_index(static_cast<std::size_t>(mesh.X.cols()), -1);
  const auto entry = [&](int a) -> int& { return new_index[static_cast<std::size_t>(a)]; };
  for_each_index(mesh, [&](int a) { entry(a) = 0; });
  int num_used = 0;
  for (int a = 0; a < mesh.X.cols(); ++a) {
    if (entry(a) < 0) continue;
    mesh.X.col(num_used) = mesh.X.col(a).eval();
    entry(a) = num_used++;
  }
  mesh.X.conservativeResize(Eigen::NoChange, num_used);
  for_each_index(mesh, [&](int& a) { a = entry(a); });
  renumber_sets(mesh, new_index);
}

}  // namespace

MeshData read_mesh(const std::filesystem::path& file, double unit,
                   const std::vector<std::string>& parts) {
  const std::string name = file.string();
  const std::string ending = lower_ending(file);
  const auto reader = std::find_if(std::begin(kReaders), std::end(kReaders),
                                   [&](const Reader& known) { return known.ending == ending; });
  if (reader == std::end(kReaders))
    throw InputError({name}, "unknown mesh format `" + ending + "`; known: " + known_endings());
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError({name}, "no such mesh file");
  if (std::filesystem::is_directory(file, error))
    throw InputError({name}, "is a folder; expected a mesh file");
  // A device may have no end, and a pipe nobody at the other end.
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError({name}, "is no regular file; expected a mesh file");
  if (!std::ifstream(file)) throw InputError({name}, "can't be opened for reading");
  if (std::filesystem::file_size(file, error) == 0)
    throw InputError({name}, "the mesh file is empty");

  MeshData mesh = reader->read(file);
  try {
    if (!parts.empty()) keep_parts(mesh, parts);
  } catch (const std::invalid_argument& error) {
    throw InputError({name}, error.what());
  }
  if (mesh.tets.cols() == 0 && mesh.triangles.cols() == 0)
    throw InputError({name}, "holds no tetrahedra and no surface triangles");
  check_indices(name, mesh);
  drop_unused_nodes(mesh);
  mesh.X *= unit;
  for (Eigen::Index a = 0; a < mesh.X.cols(); ++a)
    if (!mesh.X.col(a).allFinite())
      throw InputError({name}, "the position of point " + std::to_string(a) + " is not finite");
  refuse_far_positions(name, mesh.X);
  refuse_repeated_elements(name, mesh.tets);
  return mesh;
}

std::string lower_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, value);
  if (status != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_long(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, value);
  if (status != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::optional<int> parse_integer(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, value);
  if (status != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace articular::sim
