#include "sim/mesh/febio_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "sim/base/file_bytes.hpp"
#include "sim/base/message_text.hpp"
#include "sim/mesh/mesh_readers.hpp"

namespace articular::sim {
namespace {

struct FebioShape {
  std::string_view word;
  CellShape shape;
};
constexpr FebioShape kFebioShapes[] = {
    {"tet4", CellShape::Tetrahedron},    {"hex8", CellShape::Hexahedron},
    {"penta6", CellShape::Wedge},        {"pyra5", CellShape::Pyramid},
    {"tri3", CellShape::Triangle},       {"quad4", CellShape::Quadrilateral},
    {"q4", CellShape::Quadrilateral},    {"q4eas", CellShape::Quadrilateral},
    {"q4ans", CellShape::Quadrilateral}, {"line2", CellShape::Line},
    {"truss2", CellShape::Line}};

/// The parts of a text between commas and blanks.
std::vector<std::string_view> list_of_words(std::string_view text) {
  constexpr std::string_view kBetween = ", \t\r\n";
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t first = text.find_first_not_of(kBetween);
    if (first == std::string_view::npos) return words;
    text.remove_prefix(first);
    const std::size_t length = std::min(text.find_first_of(kBetween), text.size());
    words.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
}

class FebioMesh {
 public:
  explicit FebioMesh(const std::string& file) : file_(file), mesh_(file) {}

  /// @param data  the section <MeshData>, or nullptr
  MeshData read(const XmlElement& section, const XmlElement* data) {
    if (section.attribute("from") != nullptr)
      throw InputError(at(section), "the mesh is in another file, which is not read; put it here");
    for (const XmlElement& child : section.children)
      if (child.name == "Nodes") add_nodes(child);
    for (const XmlElement& child : section.children)
      if (child.name == "Elements") add_elements(child);
    for (const XmlElement& child : section.children) add_set(child);
    if (data != nullptr)
      for (const XmlElement& child : data->children)
        if (child.name == "ElementData") add_element_data(child);
    return mesh_.mesh();
  }

 private:
  /// Directions of fibres: data of elements with three components. A set numbers its elements from
  /// 1, by `lid`.
  void add_element_data(const XmlElement& data) {
    const std::string* const set = data.attribute("elem_set");
    const std::string* const name =
        data.attribute("name") != nullptr ? data.attribute("name") : data.attribute("var");
    if (set == nullptr || name == nullptr) return;
    const auto cells = cells_of_.find(*set);
    if (cells == cells_of_.end()) return;
    for (const XmlElement& entry : data.children) {
      const XmlElement* const vector = entry.child("a") != nullptr ? entry.child("a") : &entry;
      if (list_of_words(vector->text).size() != 3) return;  // of one component, or a matrix
      const auto place = static_cast<std::size_t>(whole(entry, "lid") - 1);
      if (place >= cells->second.size())
        throw InputError(
            at(entry), fmt::format("element {} of set {} is not there", place + 1, in_ticks(*set)));
      mesh_.set_cell_vector(*name, cells->second[place], febio_vector(at(*vector), vector->text));
    }
  }

  Location at(const XmlElement& element) const { return {file_, element.line}; }

  std::int64_t whole(const XmlElement& element, std::string_view attribute) const {
    const std::string* const text = element.attribute(attribute);
    const std::optional<std::int64_t> value = text == nullptr ? std::nullopt : parse_long(*text);
    if (!value)
      throw InputError(at(element), fmt::format("<{}> has no whole number `{}`",
                                                one_line(element.name), attribute));
    return *value;
  }

  std::string set_name(const XmlElement& element) const {
    const std::string* const name = element.attribute("name");
    return name != nullptr ? *name : "";
  }

  void add_nodes(const XmlElement& nodes) {
    const std::string name = set_name(nodes);
    for (const XmlElement& node : nodes.children) {
      const std::int64_t number = whole(node, "id");
      mesh_.add_node(number, febio_vector(at(node), node.text), node.line);
      if (!name.empty()) mesh_.add_node_to_set(name, number, node.line);
    }
  }

  CellShape shape_called(const XmlElement& element, const std::string& word) const {
    for (const FebioShape& known : kFebioShapes)
      if (known.word == word) return known.shape;
    for (const char* const second : {"tet10", "tet15", "tet20", "hex20", "hex27", "penta15",
                                     "pyra13", "tri6", "tri7", "tri10", "quad8", "quad9", "line3"})
      if (word == second) refuse_second_order(at(element), word);
    throw InputError(at(element), fmt::format("unknown kind of element {}", in_ticks(word)));
  }

  std::size_t add_cell(const XmlElement& element, CellShape shape) {
    constexpr std::size_t kMostCorners = 27;
    const std::vector<std::int64_t> nodes = febio_numbers(at(element), element.text, kMostCorners);
    if (nodes.size() != static_cast<std::size_t>(num_corners(shape)))
      throw InputError(at(element), fmt::format("found {} nodes, expected {}", nodes.size(),
                                                num_corners(shape)));
    return mesh_.add_cell(shape, nodes, element.line);
  }

  void add_elements(const XmlElement& elements) {
    const std::string* const type = elements.attribute("type");
    if (type == nullptr) throw InputError(at(elements), "<Elements> has no `type`");
    const CellShape shape = shape_called(elements, *type);
    const std::string name = febio_part_name(elements, ++num_parts_);
    for (const XmlElement& element : elements.children) {
      const std::size_t cell = add_cell(element, shape);
      cell_of_[whole(element, "id")] = cell;
      mesh_.add_cell_to_set(name, cell);
      cells_of_[name].push_back(cell);
    }
  }

  /// What is no set is passed over: pairs of surfaces, springs.
  void add_set(const XmlElement& set) {
    const std::string name = set_name(set);
    if (set.name == "NodeSet") {
      for (const std::int64_t number : members(set, mesh_.num_nodes()))
        mesh_.add_node_to_set(name, number, set.line);
    } else if (set.name == "ElementSet") {
      for (const std::int64_t number : members(set, cell_of_.size())) {
        const auto cell = cell_of_.find(number);
        if (cell == cell_of_.end())
          throw InputError(at(set), fmt::format("unknown element {}", number));
        mesh_.add_cell_to_set(name, cell->second);
        cells_of_[name].push_back(cell->second);
      }
    } else if (set.name == "Surface") {
      for (const XmlElement& face : set.children)
        mesh_.add_cell_to_set(name, add_cell(face, shape_called(face, face.name)));
    } else if (set.name == "Instance" || set.name == "Part") {
      throw InputError(at(set), "parts with instances are not read; write the model with one mesh");
    }
  }

  /// Children with `id`, or a text of numbers.
  std::vector<std::int64_t> members(const XmlElement& set, std::size_t most) const {
    if (set.children.empty()) return febio_numbers(at(set), set.text, most);
    std::vector<std::int64_t> numbers;
    for (const XmlElement& child : set.children) {
      if (child.attribute("id") == nullptr)
        throw InputError(at(child), "expected members by their `id`");
      numbers.push_back(whole(child, "id"));
    }
    return numbers;
  }

  std::string file_;
  NumberedMesh mesh_;
  int num_parts_ = 0;
  std::unordered_map<std::int64_t, std::size_t> cell_of_;
  std::unordered_map<std::string, std::vector<std::size_t>> cells_of_;  // in the order of a set
};

}  // namespace

std::string febio_part_name(const XmlElement& elements, int number) {
  const std::string* const name = elements.attribute("name");
  return name != nullptr && !name->empty() ? *name : fmt::format("part {}", number);
}

std::vector<std::int64_t> febio_numbers(const Location& where, std::string_view text,
                                        std::size_t most) {
  std::vector<std::int64_t> numbers;
  for (std::string_view word : list_of_words(text)) {
    std::int64_t range[3] = {0, 0, 1};  // first, last, step
    int count = 0;
    for (bool goes_on = true; goes_on && count < 3; ++count) {
      const std::size_t colon = word.find(':');
      const std::optional<std::int64_t> number = parse_long(word.substr(0, colon));
      if (!number) throw InputError(where, in_ticks(word) + " is not a number");
      range[count] = *number;
      goes_on = colon != std::string_view::npos;
      word.remove_prefix(goes_on ? colon + 1 : word.size());
    }
    if (count == 1) range[1] = range[0];
    if (!word.empty() || range[2] < 1)
      throw InputError(where, "expected numbers, or ranges such as 1:9");
    for (std::int64_t number = range[0]; number <= range[1]; number += range[2]) {
      if (numbers.size() == most)
        throw InputError(where, fmt::format("found more numbers than the {} that can be", most));
      numbers.push_back(number);
    }
  }
  return numbers;
}

Eigen::Vector3d febio_vector(const Location& where, std::string_view text) {
  const std::vector<std::string_view> words = list_of_words(text);
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> value = words.size() == 3 ? parse_number(words[i]) : std::nullopt;
    if (!value) throw InputError(where, in_quotes(text) + " is not three finite numbers");
    vector[static_cast<Eigen::Index>(i)] = *value;
  }
  return vector;
}

MeshData febio_mesh(const std::string& file, const XmlElement& model) {
  if (model.name != "febio_spec")
    throw InputError({file, model.line},
                     "not readable as .feb: expected a FEBio model in <febio_spec>");
  const std::string* const version = model.attribute("version");
  if (version == nullptr || (*version != "2.5" && *version != "3.0" && *version != "4.0"))
    throw InputError({file, model.line},
                     fmt::format("found version {} of FEBio's format, expected 2.5, 3.0 or 4.0",
                                 version != nullptr ? in_ticks(*version) : "none"));
  const XmlElement* const section = model.child(*version == "2.5" ? "Geometry" : "Mesh");
  if (section == nullptr)
    throw InputError({file, model.line},
                     "the model has no mesh: no section <Mesh> (version 2.5: "
                     "<Geometry>)");
  FebioMesh mesh(file);
  return mesh.read(*section, model.child("MeshData"));
}

MeshData read_febio(const std::filesystem::path& file) {
  return febio_mesh(file.string(), read_xml_tree(file.string(), ".feb", file_bytes(file)));
}

}  // namespace articular::sim
