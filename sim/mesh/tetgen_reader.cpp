#include <fmt/format.h>

#include <vector>

#include "sim/base/file_bytes.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/numbered_mesh.hpp"
#include "sim/mesh/word_reader.hpp"

namespace articular::sim {
namespace {

std::string marked_set(const char* kind, std::string_view marker) {
  return fmt::format("{} {}", kind, marker);
}

bool is_marked(std::string_view marker) { return parse_number(marker) != 0.0; }

void read_node_file(const std::filesystem::path& file, NumberedMesh& mesh) {
  const std::string bytes = file_bytes(file);
  WordReader words(file.string(), bytes, '#');
  const std::int64_t count = words.integer("the number of nodes");
  if (words.integer("the dimension") != 3)
    throw InputError(words.where(), "the nodes are not in space; expected the dimension 3");
  const std::int64_t attributes = words.integer("the number of attributes"),
                     markers = words.integer("the number of markers, 0 or 1");
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t number = words.integer("a node's number");
    Eigen::Vector3d x;
    for (double& coordinate : x) coordinate = words.number("a coordinate");
    mesh.add_node(number, x, words.where().line);
    for (std::int64_t a = 0; a < attributes; ++a) words.word("an attribute");
    if (markers == 0) continue;
    const std::string_view marker = words.word("a node's marker");
    if (is_marked(marker))
      mesh.add_node_to_set(marked_set("point", marker), number, words.where().line);
  }
}

std::vector<std::int64_t> read_nodes(WordReader& words, std::int64_t count) {
  std::vector<std::int64_t> nodes;
  for (std::int64_t a = 0; a < count; ++a) nodes.push_back(words.integer("a node's number"));
  return nodes;
}

void read_element_file(const std::filesystem::path& file, NumberedMesh& mesh) {
  const std::string bytes = file_bytes(file);
  WordReader words(file.string(), bytes, '#');
  const std::int64_t count = words.integer("the number of tetrahedra"),
                     corners = words.integer("the nodes of a tetrahedron, 4");
  if (corners == 10) refuse_second_order(words.where(), "tetrahedra of 10 nodes");
  if (corners != 4)
    throw InputError(words.where(),
                     fmt::format("found {} nodes for each tetrahedron; expected 4", corners));
  const std::int64_t attributes = words.integer("the number of attributes, 0 or 1");
  for (std::int64_t k = 0; k < count; ++k) {
    words.integer("a tetrahedron's number");
    const int line = words.where().line;
    const std::size_t cell = mesh.add_cell(CellShape::Tetrahedron, read_nodes(words, 4), line);
    for (std::int64_t a = 0; a < attributes; ++a) {
      const std::string_view region = words.word("a region");
      if (a == 0 && is_marked(region)) mesh.add_cell_to_set(marked_set("volume", region), cell);
    }
  }
}

void read_face_file(const std::filesystem::path& file, NumberedMesh& mesh) {
  const std::string bytes = file_bytes(file);
  WordReader words(file.string(), bytes, '#');
  const std::int64_t count = words.integer("the number of faces"),
                     markers = words.integer("the number of markers, 0 or 1");
  for (std::int64_t k = 0; k < count; ++k) {
    words.integer("a face's number");
    const int line = words.where().line;
    const std::size_t cell = mesh.add_cell(CellShape::Triangle, read_nodes(words, 3), line);
    if (markers == 0) continue;
    const std::string_view marker = words.word("a face's marker");
    if (is_marked(marker)) mesh.add_cell_to_set(marked_set("surface", marker), cell);
  }
}

}  // namespace

MeshData read_tetgen(const std::filesystem::path& file) {
  const auto with_ending = [&](const char* ending) {
    return std::filesystem::path(file).replace_extension(ending);
  };
  std::error_code error;
  for (const char* const needed : {".node", ".ele"})
    if (!std::filesystem::exists(with_ending(needed), error))
      throw InputError({file.string()}, fmt::format("a mesh of TetGen needs {} beside it",
                                                    with_ending(needed).filename().string()));
  NumberedMesh mesh(with_ending(".ele").string());
  read_node_file(with_ending(".node"), mesh);
  read_element_file(with_ending(".ele"), mesh);
  if (std::filesystem::exists(with_ending(".face"), error))
    read_face_file(with_ending(".face"), mesh);
  return mesh.mesh();
}

}  // namespace articular::sim
