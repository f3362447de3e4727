#include <array>
#include <cctype>
#include <fstream>
#include <unordered_map>

#include "sim/base/error.hpp"
#include "sim/mesh/mesh_readers.hpp"

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

/// `*ELEMENT, type = C3D4, ELSET=disc`: the value of the option, in capitals, or "".
std::string option(const std::vector<std::string_view>& keyword_line, std::string_view name) {
  for (std::string_view part : keyword_line) {
    const std::size_t equals = part.find('=');
    if (equals != std::string_view::npos && upper(trimmed(part.substr(0, equals))) == name)
      return upper(trimmed(part.substr(equals + 1)));
  }
  return "";
}

class AbaqusDeck {
 public:
  explicit AbaqusDeck(std::string file) : where_{std::move(file)} {}

  void read(std::istream& in) {
    for (std::string text; std::getline(in, text);) {
      ++where_.line;
      const std::string_view line = trimmed(text);
      if (line.empty() || line.starts_with("**")) continue;
      if (line.starts_with('*'))
        begin_block(columns(line.substr(1)));
      else if (block_ == Block::Nodes)
        add_node(columns(line));
      else if (block_ == Block::Tetrahedra)
        add_tetrahedron(columns(line));
    }
  }

  /// Elements may stand before their nodes, so numbers become indices at the end.
  MeshData mesh() const {
    if (node_index_.empty()) throw InputError({where_.file}, "holds no *NODE lines");
    if (elements_.empty())
      throw InputError(
          {where_.file},
          "holds no elements of type C3D4 (linear tetrahedra)" +
              (skipped_.empty() ? "" : "; there are elements of type " + one_line(skipped_)));
    MeshData mesh;
    mesh.X = Eigen::Map<const Positions>(coordinates_.data(), 3,
                                         static_cast<Eigen::Index>(coordinates_.size() / 3));
    mesh.tets.resize(4, static_cast<Eigen::Index>(elements_.size()));
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      for (std::size_t a = 0; a < 4; ++a) {
        const auto node = node_index_.find(elements_[e].nodes[a]);
        if (node == node_index_.end())
          throw InputError({where_.file, elements_[e].line},
                           "unknown node " + std::to_string(elements_[e].nodes[a]));
        mesh.tets(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(e)) = node->second;
      }
    }
    return mesh;
  }

 private:
  enum class Block { Skipped, Nodes, Tetrahedra };
  struct Element {
    std::array<int, 4> nodes;
    int line;
  };

  void begin_block(const std::vector<std::string_view>& keyword_line) {
    const std::string keyword = upper(keyword_line.front());
    block_ = Block::Skipped;
    if (keyword == "NODE") block_ = Block::Nodes;
    if (keyword == "ELEMENT") {
      const std::string type = option(keyword_line, "TYPE");
      if (type == "C3D4")
        block_ = Block::Tetrahedra;
      else
        skipped_ = type;
    }
    if (keyword == "INCLUDE" || !option(keyword_line, "INPUT").empty())
      throw InputError(where_, "data in another file is not read; put it into this one");
  }

  void expect_columns(const std::vector<std::string_view>& parts, std::size_t count,
                      const char* meaning) const {
    if (parts.size() != count)
      throw InputError(where_, "found " + std::to_string(parts.size()) + " columns, expected " +
                                   std::to_string(count) + ": " + meaning);
  }

  int node_number(std::string_view text) const {
    const std::optional<int> number = parse_integer(text);
    if (!number) throw InputError(where_, "`" + one_line(text) + "` is not a node number");
    return *number;
  }

  void add_node(const std::vector<std::string_view>& parts) {
    expect_columns(parts, 4, "node number, x, y, z");
    const int number = node_number(parts[0]);
    if (!node_index_.emplace(number, static_cast<int>(node_index_.size())).second)
      throw InputError(where_, "node " + std::to_string(number) + " is there twice");
    for (std::size_t i = 1; i < 4; ++i) {
      const std::optional<double> value = parse_number(parts[i]);
      if (!value) throw InputError(where_, "`" + one_line(parts[i]) + "` is not a finite number");
      coordinates_.push_back(*value);
    }
  }

  void add_tetrahedron(const std::vector<std::string_view>& parts) {
    expect_columns(parts, 5, "element number and 4 node numbers");
    if (!parse_integer(parts[0]))
      throw InputError(where_, "`" + one_line(parts[0]) + "` is not an element number");
    Element element{{}, where_.line};
    for (std::size_t a = 0; a < 4; ++a) element.nodes[a] = node_number(parts[a + 1]);
    elements_.push_back(element);
  }

  Location where_;
  Block block_ = Block::Skipped;
  std::unordered_map<int, int> node_index_;  // number in the file -> index
  std::vector<double> coordinates_;          // x0 y0 z0 x1 ...
  std::vector<Element> elements_;
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
