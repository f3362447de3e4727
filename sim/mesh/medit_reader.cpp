#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "sim/base/file_bytes.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/numbered_mesh.hpp"
#include "sim/mesh/word_reader.hpp"

namespace articular::sim {
namespace {

struct MeditCells {
  std::string_view keyword;
  CellShape shape;
  const char* set;  // of a reference, before its number
};
constexpr MeditCells kMeditCells[] = {{"Edges", CellShape::Line, "line"},
                                      {"Triangles", CellShape::Triangle, "surface"},
                                      {"Quadrilaterals", CellShape::Quadrilateral, "surface"},
                                      {"Tetrahedra", CellShape::Tetrahedron, "volume"},
                                      {"Pyramids", CellShape::Pyramid, "volume"},
                                      {"Prisms", CellShape::Wedge, "volume"},
                                      {"Hexahedra", CellShape::Hexahedron, "volume"}};

std::string numbered_set(const char* kind, std::int64_t number) {
  return std::string(kind) + " " + std::to_string(number);
}

void read_medit_vertices(WordReader& words, NumberedMesh& mesh) {
  const std::int64_t count = words.integer("the number of vertices");
  for (std::int64_t number = 1; number <= count; ++number) {
    Eigen::Vector3d x;
    for (double& coordinate : x) coordinate = words.number("a coordinate");
    mesh.add_node(number, x, words.where().line);
    const std::int64_t reference = words.integer("a vertex's reference");
    if (reference != 0)
      mesh.add_node_to_set(numbered_set("point", reference), number, words.where().line);
  }
}

void read_medit_cells(WordReader& words, const MeditCells& kind, NumberedMesh& mesh) {
  const std::int64_t count = words.integer("the number of elements");
  std::vector<std::int64_t> nodes(static_cast<std::size_t>(num_corners(kind.shape)));
  for (std::int64_t k = 0; k < count; ++k) {
    for (std::int64_t& node : nodes) node = words.integer("a vertex's number");
    const std::size_t cell = mesh.add_cell(kind.shape, nodes, words.where().line);
    const std::int64_t reference = words.integer("an element's reference");
    if (reference != 0) mesh.add_cell_to_set(numbered_set(kind.set, reference), cell);
  }
}

}  // namespace

MeshData read_medit(const std::filesystem::path& file) {
  const std::string bytes = file_bytes(file);
  WordReader words(file.string(), bytes, '#');
  NumberedMesh mesh(file.string());
  bool has_begun = false;
  while (!words.at_end()) {
    const std::string_view word = words.word("a keyword");
    const auto* kind = std::find_if(std::begin(kMeditCells), std::end(kMeditCells),
                                    [&](const MeditCells& known) { return known.keyword == word; });
    if (!has_begun && word != "MeshVersionFormatted")
      throw InputError(words.where(), "a Medit mesh begins with `MeshVersionFormatted`");
    has_begun = true;
    if (word == "End") break;
    if (word == "Dimension") {
      if (words.integer("the dimension") != 3)
        throw InputError(words.where(), "the mesh is flat; expected `Dimension 3`");
    } else if (word == "Vertices") {
      read_medit_vertices(words, mesh);
    } else if (kind != std::end(kMeditCells)) {
      read_medit_cells(words, *kind, mesh);
    } else if (word.ends_with("P2") || word.ends_with("Q2")) {
      refuse_second_order(words.where(), word);
    }  // else it is a number of what is skipped, or its keyword
  }
  return mesh.mesh();
}

}  // namespace articular::sim
