#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>
#include <unordered_map>

#include "sim/base/error.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/numbered_mesh.hpp"

namespace articular::sim {
namespace {

/// Cut at commas, each part trimmed; one empty part after a comma at the end is dropped.
std::vector<std::string_view> columns(std::string_view line) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = line.find(',');
    parts.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  if (parts.size() > 1 && parts.back().empty()) parts.pop_back();
  return parts;
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// `*ELEMENT, type = C3D4, ELSET=disc`: the value of the option as it is, or "".
std::string option(const std::vector<std::string_view>& keyword_line, std::string_view name) {
  for (std::string_view part : keyword_line) {
    const std::size_t equals = part.find('=');
    if (equals != std::string_view::npos && upper(trimmed(part.substr(0, equals))) == name)
      return std::string(trimmed(part.substr(equals + 1)));
  }
  return "";
}

bool has_flag(const std::vector<std::string_view>& keyword_line, std::string_view name) {
  return std::any_of(keyword_line.begin(), keyword_line.end(),
                     [&](std::string_view part) { return upper(part) == name; });
}

struct AbaqusType {
  std::string_view beginning;  // of the word: C3D8R is a C3D8
  CellShape shape;
};
constexpr AbaqusType kAbaqusTypes[] = {
    {"C3D4", CellShape::Tetrahedron},   {"C3D5", CellShape::Pyramid},
    {"C3D6", CellShape::Wedge},         {"C3D8", CellShape::Hexahedron},
    {"S3", CellShape::Triangle},        {"STRI3", CellShape::Triangle},
    {"CPS3", CellShape::Triangle},      {"CPE3", CellShape::Triangle},
    {"M3D3", CellShape::Triangle},      {"SFM3D3", CellShape::Triangle},
    {"R3D3", CellShape::Triangle},      {"S4", CellShape::Quadrilateral},
    {"CPS4", CellShape::Quadrilateral}, {"CPE4", CellShape::Quadrilateral},
    {"M3D4", CellShape::Quadrilateral}, {"SFM3D4", CellShape::Quadrilateral},
    {"R3D4", CellShape::Quadrilateral}};

/// Corners of the faces S1, S2, ... of a solid.
std::vector<std::vector<std::size_t>> abaqus_faces(CellShape solid) {
  switch (solid) {
    case CellShape::Tetrahedron:
      return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    case CellShape::Pyramid:
      return {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    case CellShape::Wedge:
      return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
    case CellShape::Hexahedron:
      return {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    default:
      return {};
  }
}

class AbaqusDeck {
 public:
  explicit AbaqusDeck(const std::string& file) : where_{file}, mesh_(file) {}

  void read(std::istream& in) {
    for (std::string text; std::getline(in, text);) {
      ++where_.line;
      const std::string_view line = trimmed(text);
      if (line.empty() || line.starts_with("**")) continue;
      if (line.starts_with('*'))
        begin_block(columns(line.substr(1)));
      else if (block_ != Block::Skipped)
        add_line(line);
    }
    finish_element();
  }

  MeshData mesh() {
    if (node_numbers_.empty()) throw InputError({where_.file}, "holds no *NODE lines");
    add_sets();
    for (const SurfaceFace& face : surface_faces_) add_surface_face(face);
    MeshData mesh = mesh_.mesh();
    if (mesh.tets.cols() == 0 && mesh.triangles.cols() == 0)
      throw InputError(
          {where_.file},
          "holds no elements of type C3D4 (linear tetrahedra) or another that is read" +
              (skipped_.empty() ? "" : "; there are elements of type " + one_line(skipped_)));
    return mesh;
  }

 private:
  enum class Block { Skipped, Nodes, Elements, NodeSet, ElementSet, Surface };
  struct Element {
    CellShape shape;
    std::vector<std::int64_t> nodes;
    std::size_t cell;
  };
  /// From one number to another in steps.
  using Range = std::array<std::int64_t, 3>;
  struct Members {
    std::string name;  // as it was first: names are the same in any case of letters
    int line;
    std::vector<Range> ranges;
  };
  using Sets = std::map<std::string, Members>;  // by the name in capitals

  struct SurfaceFace {
    std::string surface, elements;
    std::size_t face;
    int line;
  };

  void begin_block(const std::vector<std::string_view>& keyword_line) {
    finish_element();
    const std::string keyword = upper(keyword_line.front());
    block_ = Block::Skipped;
    if (keyword == "INCLUDE" || !option(keyword_line, "INPUT").empty())
      throw InputError(where_, "data in another file is not read; put it into this one");
    refuse_makers(keyword, upper(option(keyword_line, "SYSTEM")));
    if (keyword == "NODE") {
      block_ = Block::Nodes;
      set_ = option(keyword_line, "NSET");
    } else if (keyword == "ELEMENT") {
      begin_elements(upper(option(keyword_line, "TYPE")));
      set_ = option(keyword_line, "ELSET");
    } else if (keyword == "NSET" || keyword == "ELSET") {
      block_ = keyword == "NSET" ? Block::NodeSet : Block::ElementSet;
      set_ = option(keyword_line, keyword);
      is_range_ = has_flag(keyword_line, "GENERATE");
    } else if (keyword == "SURFACE" && upper(option(keyword_line, "TYPE")) != "NODE") {
      block_ = Block::Surface;
      set_ = option(keyword_line, "NAME");
    }
    is_instance_ = keyword == "INSTANCE";
    if (is_instance_) block_ = Block::Surface;  // its lines move it
  }

  /// Keywords that move nodes, or make nodes and elements that are not listed.
  void refuse_makers(const std::string& keyword, const std::string& system) const {
    constexpr std::string_view kMakers[] = {"SYSTEM", "NGEN",  "NFILL", "NMAP",
                                            "NCOPY",  "ELGEN", "ELCOPY"};
    if (std::find(std::begin(kMakers), std::end(kMakers), keyword) != std::end(kMakers))
      throw InputError(where_,
                       "*" + keyword +
                           " is not read; write the deck with every node and element listed, "
                           "in one Cartesian system");
    if (keyword == "NODE" && !system.empty() && system != "R")
      throw InputError(where_,
                       "nodes in a cylindrical or spherical system are not read; expected "
                       "Cartesian coordinates");
  }

  void begin_elements(const std::string& type) {
    for (const AbaqusType& known : kAbaqusTypes)
      if (type.starts_with(known.beginning) &&
          (type.size() == known.beginning.size() ||
           std::isdigit(static_cast<unsigned char>(type[known.beginning.size()])) == 0)) {
        block_ = Block::Elements;
        shape_ = known.shape;
      }
    if (block_ == Block::Elements) return;
    if (type.starts_with("C3D10") || type.starts_with("C3D15") || type.starts_with("C3D20") ||
        type.starts_with("C3D27"))
      refuse_second_order(where_, type);
    skipped_ = type;
  }

  void add_line(std::string_view line) {
    if (is_instance_)
      throw InputError(where_,
                       "an *INSTANCE that is moved is not read; write the deck without parts and "
                       "assemblies (a flat input file)");
    const std::vector<std::string_view> parts = columns(line);
    switch (block_) {
      case Block::Nodes:
        return add_node(parts);
      case Block::Elements:
        return add_element(parts, line.ends_with(','));
      case Block::NodeSet:
      case Block::ElementSet:
        return is_range_ ? add_range(parts) : add_members(parts);
      default:
        return add_surface(parts);
    }
  }

  void expect_columns(const std::vector<std::string_view>& parts, std::size_t count,
                      const std::string& meaning) const {
    if (parts.size() != count)
      throw InputError(where_, "found " + std::to_string(parts.size()) + " columns, expected " +
                                   std::to_string(count) + ": " + meaning);
  }

  std::int64_t number(std::string_view text, const char* noun) const {
    const std::optional<std::int64_t> value = parse_long(text);
    if (!value) throw InputError(where_, "`" + one_line(text) + "` is not " + noun);
    return *value;
  }

  void add_node(const std::vector<std::string_view>& parts) {
    expect_columns(parts, 4, "node number, x, y, z");
    const std::int64_t node = number(parts[0], "a node number");
    Eigen::Vector3d x;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<double> value = parse_number(parts[i + 1]);
      if (!value)
        throw InputError(where_, "`" + one_line(parts[i + 1]) + "` is not a finite number");
      x[static_cast<Eigen::Index>(i)] = *value;
    }
    mesh_.add_node(node, x, where_.line);
    node_numbers_.push_back(node);
    if (!set_.empty()) add_member(node_sets_, node);
  }

  /// An element's line that ends with a comma goes on below.
  void add_element(const std::vector<std::string_view>& parts, bool goes_on) {
    for (const std::string_view part : parts) {
      const bool is_element = element_.empty();
      element_.push_back(number(part, is_element ? "an element number" : "a node number"));
    }
    if (!goes_on) finish_element();
  }

  void finish_element() {
    if (element_.empty()) return;
    const auto corners = static_cast<std::size_t>(num_corners(shape_));
    if (element_.size() != corners + 1)
      throw InputError(where_, fmt::format("found {} columns, expected {}: element number and {} "
                                           "node numbers",
                                           element_.size(), corners + 1, corners));
    const std::int64_t number = element_.front();
    element_.erase(element_.begin());
    const std::size_t cell = mesh_.add_cell(shape_, element_, where_.line);
    if (!set_.empty()) add_member(element_sets_, number);
    elements_[number] = {shape_, std::move(element_), cell};
    element_.clear();
  }

  Sets& sets_of_block() { return block_ == Block::NodeSet ? node_sets_ : element_sets_; }

  Members& members(Sets& sets) const {
    return sets.try_emplace(upper(set_), Members{set_, where_.line, {}}).first->second;
  }

  void add_member(Sets& sets, std::int64_t number) const {
    members(sets).ranges.push_back({number, number, 1});
  }

  /// Numbers, and names of sets above.
  void add_members(const std::vector<std::string_view>& parts) {
    Sets& sets = sets_of_block();
    for (const std::string_view part : parts) {
      if (part.empty()) continue;
      if (const std::optional<std::int64_t> number = parse_long(part)) {
        add_member(sets, *number);
        continue;
      }
      const auto other = sets.find(upper(part));
      if (other == sets.end()) throw InputError(where_, "unknown set " + in_ticks(part));
      const std::vector<Range> added = other->second.ranges;
      std::vector<Range>& ranges = members(sets).ranges;
      ranges.insert(ranges.end(), added.begin(), added.end());
      std::sort(ranges.begin(), ranges.end());
      ranges.erase(std::unique(ranges.begin(), ranges.end()), ranges.end());
    }
  }

  void add_range(const std::vector<std::string_view>& parts) {
    if (parts.size() != 2 && parts.size() != 3)
      throw InputError(where_, "found " + std::to_string(parts.size()) +
                                   " columns, expected 2 or 3: first number, last one, step");
    const Range range{number(parts[0], "a number"), number(parts[1], "a number"),
                      parts.size() == 3 ? number(parts[2], "a number") : 1};
    if (range[2] < 1 || range[1] < range[0])
      throw InputError(where_,
                       "expected a first number, a last one that is not smaller, a positive step");
    members(sets_of_block()).ranges.push_back(range);
  }

  /// Numbers of a set: all that are named one by one, and of ranges those that exist.
  static std::vector<std::int64_t> numbers_of(const Members& set,
                                              const std::vector<std::int64_t>& existing) {
    std::vector<std::int64_t> numbers;
    for (const auto& [first, last, step] : set.ranges) {
      if (first == last) numbers.push_back(first);
      if (first == last) continue;
      for (auto number = std::lower_bound(existing.begin(), existing.end(), first);
           number != existing.end() && *number <= last; ++number)
        if ((*number - first) % step == 0) numbers.push_back(*number);
    }
    return numbers;
  }

  void add_sets() {
    std::sort(node_numbers_.begin(), node_numbers_.end());
    for (const auto& [number, element] : elements_) element_numbers_.push_back(number);
    std::sort(element_numbers_.begin(), element_numbers_.end());
    for (const auto& [capitals, set] : node_sets_)
      for (const std::int64_t number : numbers_of(set, node_numbers_))
        mesh_.add_node_to_set(set.name, number, set.line);
    for (const auto& [capitals, set] : element_sets_)
      for (const std::int64_t number : numbers_of(set, element_numbers_))
        if (const Element* found = element(number, set.line))
          mesh_.add_cell_to_set(set.name, found->cell);
  }

  void add_surface(const std::vector<std::string_view>& parts) {
    if (parts.size() == 1) return;  // all free faces of a set: no part of them is named
    const std::string face = upper(parts.back());
    if (parts.size() != 2 || face.size() != 2 || face[0] != 'S' || face[1] < '1' || face[1] > '6')
      return;  // a face of a shell, SPOS or SNEG
    surface_faces_.push_back(
        {set_, std::string(parts[0]), static_cast<std::size_t>(face[1] - '1'), where_.line});
  }

  /// Elements of a surface: a number, or the name of a set.
  std::vector<std::int64_t> elements_called(const SurfaceFace& face) const {
    if (const std::optional<std::int64_t> number = parse_long(face.elements)) return {*number};
    const auto found = element_sets_.find(upper(face.elements));
    if (found == element_sets_.end())
      throw InputError({where_.file, face.line}, "unknown set " + in_ticks(face.elements));
    return numbers_of(found->second, element_numbers_);
  }

  /// nullptr: it may be of a type that is skipped.
  const Element* element(std::int64_t number, int line) const {
    const auto found = elements_.find(number);
    if (found != elements_.end()) return &found->second;
    if (!skipped_.empty()) return nullptr;
    throw InputError({where_.file, line}, fmt::format("unknown element {}", number));
  }

  void add_surface_face(const SurfaceFace& face) {
    for (const std::int64_t number : elements_called(face)) {
      const Element* const solid = element(number, face.line);
      if (solid == nullptr) continue;
      const auto faces = abaqus_faces(solid->shape);
      if (face.face >= faces.size())
        throw InputError({where_.file, face.line},
                         fmt::format("element {} has no face S{}", number, face.face + 1));
      std::vector<std::int64_t> nodes;
      for (const std::size_t corner : faces[face.face]) nodes.push_back(solid->nodes[corner]);
      const CellShape shape = nodes.size() == 3 ? CellShape::Triangle : CellShape::Quadrilateral;
      mesh_.add_cell_to_set(face.surface, mesh_.add_cell(shape, nodes, face.line));
    }
  }

  Location where_;
  NumberedMesh mesh_;
  Block block_ = Block::Skipped;
  CellShape shape_ = CellShape::Tetrahedron;
  std::string set_;  // of the block
  bool is_range_ = false, is_instance_ = false;
  std::vector<std::int64_t> element_;  // number and nodes so far
  std::unordered_map<std::int64_t, Element> elements_;
  Sets node_sets_, element_sets_;
  std::vector<std::int64_t> node_numbers_, element_numbers_;
  std::vector<SurfaceFace> surface_faces_;
  std::string skipped_;  // an element type that is not read, for the message
};

}  // namespace

MeshData read_abaqus(const std::filesystem::path& file) {
  std::ifstream in(file);
  AbaqusDeck deck(file.string());
  deck.read(in);
  return deck.mesh();
}

}  // namespace articular::sim
