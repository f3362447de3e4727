#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <vector>

#include "sim/base/file_bytes.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/numbered_mesh.hpp"
#include "sim/mesh/word_reader.hpp"

namespace articular::sim {
namespace {

static_assert(std::endian::native == std::endian::little, "binary .msh is read as it lies");

constexpr int kOne = 1;  // what a binary file begins with

/// Gmsh's number of a kind of cell.
std::optional<CellShape> shape_of(std::int64_t type) {
  switch (type) {
    case 1:
      return CellShape::Line;
    case 2:
      return CellShape::Triangle;
    case 3:
      return CellShape::Quadrilateral;
    case 4:
      return CellShape::Tetrahedron;
    case 5:
      return CellShape::Hexahedron;
    case 6:
      return CellShape::Wedge;
    case 7:
      return CellShape::Pyramid;
    case 15:
      return CellShape::Point;
    default:
      return std::nullopt;
  }
}

int dimension_of(CellShape shape) {
  if (is_solid(shape)) return 3;
  return shape == CellShape::Point ? 0 : shape == CellShape::Line ? 1 : 2;
}

class GmshFile {
 public:
  explicit GmshFile(const std::filesystem::path& file)
      : bytes_(file_bytes(file)), words_(file.string(), bytes_), mesh_(file.string()) {}

  MeshData read() {
    read_format();
    while (!words_.at_end()) {
      const std::string section(words_.word("a section, such as $Nodes"));
      words_.rest_of_line();
      if (section == "$PhysicalNames")
        read_physical_names();
      else if (section == "$Entities")
        read_entities();
      else if (section == "$Nodes")
        is_4_ ? read_nodes_4() : read_nodes_2();
      else if (section == "$Elements")
        is_4_ ? read_elements_4() : read_elements_2();
      else if (!section.starts_with('$'))
        throw InputError(
            where(), fmt::format("found {}, expected a section such as $Nodes", in_ticks(section)));
      skip_to_end_of(section);
    }
    return mesh_.mesh();
  }

 private:
  using Entity = std::pair<std::int64_t, std::int64_t>;  // dimension, tag

  void read_format() {
    if (words_.at_end() || words_.word("$MeshFormat") != "$MeshFormat")
      throw InputError(where(), "a Gmsh mesh begins with $MeshFormat");
    const std::string version(words_.word("a version"));
    if (version != "2.2" && version != "4.1")
      throw InputError(where(),
                       fmt::format("the mesh has Gmsh's version {}; expected 2.2 or 4.1, which "
                                   "`gmsh -save -format msh41 FILE` writes",
                                   one_line(version)));
    is_4_ = version == "4.1";
    const std::int64_t type = words_.integer("0 (text) or 1 (binary)");
    const std::int64_t size = words_.integer("the size of numbers, 8");
    if (size != 8)
      throw InputError(where(), fmt::format("numbers have {} bytes; expected 8", size));
    is_binary_ = type == 1;
    words_.rest_of_line();
    if (is_binary_ && take<int>() != kOne)
      throw InputError(where(),
                       "the binary mesh is of the other byte order; expected one written on an "
                       "x86-64 processor, or a text file");
    skip_to_end_of("$MeshFormat");
  }

  /// Behind the line with "$End...", wherever reading has come to.
  void skip_to_end_of(const std::string& section) {
    const std::string end = "$End" + section.substr(1);
    const std::size_t at = bytes_.find(end, words_.position());
    if (at == std::string::npos)
      throw InputError(where(),
                       fmt::format("the section {} has no {}", one_line(section), one_line(end)));
    words_.skip_to(at + end.size());
  }

  /// A number of a binary file. Numbers begin behind the end of the line.
  template <class T>
  T take() {
    if (at_line_end()) words_.skip_to(words_.position() + 1);
    if (bytes_.size() - words_.position() < sizeof(T))
      throw InputError(where(), "the binary file ends within a section");
    T value;
    std::memcpy(&value, bytes_.data() + words_.position(), sizeof(T));
    words_.skip_to(words_.position() + sizeof(T));
    has_taken_ = true;
    return value;
  }

  /// Only before the first number of a section: any other byte is part of a number.
  bool at_line_end() {
    if (has_taken_) return false;
    return words_.position() < bytes_.size() && bytes_[words_.position()] == '\n';
  }

  /// A binary file has no lines.
  Location where() const { return is_binary_ ? Location{words_.where().file} : words_.where(); }

  std::int64_t small(const char* expected) {
    return is_binary_ ? take<std::int32_t>() : words_.integer(expected);
  }
  std::int64_t large(const char* expected) {
    return is_binary_ ? take<std::int64_t>() : words_.integer(expected);
  }
  double real(const char* expected) {
    return is_binary_ ? take<double>() : words_.number(expected);
  }
  Eigen::Vector3d position() {
    Eigen::Vector3d x;
    for (double& coordinate : x) coordinate = real("a coordinate");
    return x;
  }

  /// In text in either kind of file.
  void read_physical_names() {
    const std::int64_t count = words_.integer("the number of physical names");
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t dimension = words_.integer("a dimension");
      const std::int64_t tag = words_.integer("a physical tag");
      std::string_view name = words_.rest_of_line();
      if (name.size() < 2 || name.front() != '"' || name.back() != '"')
        throw InputError(where(),
                         fmt::format("found {}, expected a name in double quotes", in_ticks(name)));
      names_[{dimension, tag}] = name.substr(1, name.size() - 2);
    }
  }

  void read_entities() {
    has_taken_ = false;
    std::int64_t counts[4];
    for (std::int64_t& count : counts) count = large("a number of entities");
    for (std::int64_t dimension = 0; dimension < 4; ++dimension)
      for (std::int64_t k = 0; k < counts[dimension]; ++k) read_entity(dimension);
  }

  void read_entity(std::int64_t dimension) {
    const std::int64_t tag = small("an entity's tag");
    for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) real("a bound of an entity");
    const std::int64_t num_physical = large("a number of physical tags");
    for (std::int64_t p = 0; p < num_physical; ++p)
      physical_[{dimension, tag}].push_back(small("a physical tag"));
    if (dimension == 0) return;
    const std::int64_t num_bounding = large("a number of bounding entities");
    for (std::int64_t b = 0; b < num_bounding; ++b) small("a bounding entity");
  }

  /// The count is text in either kind of file.
  std::int64_t begin_section_2(const char* expected) {
    const std::int64_t count = words_.integer(expected);
    if (is_binary_) words_.rest_of_line();
    has_taken_ = false;
    return count;
  }

  void read_nodes_2() {
    const std::int64_t count = begin_section_2("the number of nodes");
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t number = small("a node's number");
      mesh_.add_node(number, position(), where().line);
    }
  }

  void read_nodes_4() {
    has_taken_ = false;
    const std::int64_t blocks = large("a number of blocks");
    for (int k = 0; k < 3; ++k) large("a number of nodes");
    for (std::int64_t b = 0; b < blocks; ++b) {
      const std::int64_t dimension = small("a dimension");
      small("an entity's tag");
      const bool is_parametric = small("0 or 1") != 0;
      const std::int64_t count = large("a number of nodes");
      std::vector<std::int64_t> numbers;
      for (std::int64_t k = 0; k < count; ++k) numbers.push_back(large("a node's number"));
      for (const std::int64_t number : numbers) {
        mesh_.add_node(number, position(), where().line);
        for (std::int64_t p = 0; is_parametric && p < dimension; ++p) real("a parameter");
      }
    }
  }

  CellShape read_shape() {
    const std::int64_t type = small("a type of element");
    const std::optional<CellShape> shape = shape_of(type);
    if (!shape) refuse_second_order(where(), fmt::format("Gmsh's type {}", type));
    return *shape;
  }

  void read_elements_2() {
    const std::int64_t count = begin_section_2("the number of elements");
    for (std::int64_t k = 0; k < count;) {
      if (!is_binary_) words_.integer("an element's number");
      const CellShape shape = read_shape();
      const std::int64_t following = is_binary_ ? small("a number of elements") : 1;
      const std::int64_t num_tags = small("a number of tags");
      for (std::int64_t e = 0; e < following; ++e) {
        if (is_binary_) small("an element's number");
        std::int64_t physical = 0;
        for (std::int64_t t = 0; t < num_tags; ++t) {
          const std::int64_t tag = small("a tag");
          if (t == 0) physical = tag;
        }
        const std::size_t cell = read_cell(shape, [this] { return small("a node's number"); });
        if (physical != 0) add_to_group(shape, physical, cell);
      }
      k += std::max<std::int64_t>(following, 1);
    }
  }

  void read_elements_4() {
    has_taken_ = false;
    const std::int64_t blocks = large("a number of blocks");
    for (int k = 0; k < 3; ++k) large("a number of elements");
    for (std::int64_t b = 0; b < blocks; ++b) {
      const std::int64_t dimension = small("a dimension");
      const std::int64_t entity = small("an entity's tag");
      const CellShape shape = read_shape();
      const std::int64_t count = large("a number of elements");
      const auto groups = physical_.find({dimension, entity});
      for (std::int64_t e = 0; e < count; ++e) {
        large("an element's number");
        const std::size_t cell = read_cell(shape, [this] { return large("a node's number"); });
        if (groups == physical_.end()) continue;
        for (const std::int64_t physical : groups->second) add_to_group(shape, physical, cell);
      }
    }
  }

  template <class Next>
  std::size_t read_cell(CellShape shape, Next next) {
    std::int64_t nodes[8];
    const auto count = static_cast<std::size_t>(num_corners(shape));
    for (std::size_t a = 0; a < count; ++a) nodes[a] = next();
    return mesh_.add_cell(shape, {nodes, count}, where().line);
  }

  /// Gmsh 2.2 gives a negative tag to an element that is turned over.
  void add_to_group(CellShape shape, std::int64_t physical, std::size_t cell) {
    constexpr const char* kKinds[] = {"point", "line", "surface", "volume"};
    const std::int64_t tag = physical < 0 ? -physical : physical;
    const int dimension = dimension_of(shape);
    const auto name = names_.find({dimension, tag});
    mesh_.add_cell_to_set(
        name != names_.end() ? name->second : fmt::format("{} {}", kKinds[dimension], tag), cell);
  }

  std::string bytes_;
  WordReader words_;
  NumberedMesh mesh_;
  bool is_4_ = false, is_binary_ = false, has_taken_ = false;
  std::map<Entity, std::string> names_;                   // of physical groups
  std::map<Entity, std::vector<std::int64_t>> physical_;  // groups of an entity
};

}  // namespace

MeshData read_gmsh(const std::filesystem::path& file) { return GmshFile(file).read(); }

}  // namespace articular::sim
