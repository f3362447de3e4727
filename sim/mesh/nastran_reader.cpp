#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <vector>

#include "sim/base/error.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/numbered_mesh.hpp"

namespace articular::sim {
namespace {

/// A card with what continues it: its word and its fields, which may be empty.
struct Card {
  std::string word;
  std::vector<std::string> fields;
  int line = 0;
};

struct NastranCell {
  std::string_view word;
  CellShape shape;
  const char* set;
};
constexpr NastranCell kNastranCells[] = {
    {"CTETRA", CellShape::Tetrahedron, "volume"},   {"CPYRAM", CellShape::Pyramid, "volume"},
    {"CPYRA", CellShape::Pyramid, "volume"},        {"CPENTA", CellShape::Wedge, "volume"},
    {"CHEXA", CellShape::Hexahedron, "volume"},     {"CTRIA3", CellShape::Triangle, "surface"},
    {"CQUAD4", CellShape::Quadrilateral, "surface"}};

std::string in_capitals(std::string_view text) {
  std::string result(trimmed(text));
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// A line cut into the card's word and its fields: at commas, or every 8 characters, or every 16
/// behind a word with a star.
std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  if (line.find(',') != std::string_view::npos) {
    while (true) {
      const std::size_t comma = line.find(',');
      fields.emplace_back(trimmed(line.substr(0, comma)));
      if (comma == std::string_view::npos) return fields;
      line.remove_prefix(comma + 1);
    }
  }
  const std::size_t width = line.substr(0, 8).find('*') != std::string_view::npos ? 16 : 8;
  for (std::size_t at = 0; at < std::min<std::size_t>(line.size(), 72);) {
    const std::size_t wide = at == 0 ? 8 : width;
    fields.emplace_back(trimmed(line.substr(at, std::min(wide, 72 - at))));
    at += wide;
  }
  return fields;
}

/// Nastran leaves out the E of an exponent: 1.5-3 is 0.0015.
std::optional<double> nastran_number(std::string text) {
  for (char& c : text)
    if (c == 'D' || c == 'd') c = 'E';
  const std::size_t sign = text.find_last_of("+-");
  if (sign != std::string::npos && sign > 0 && text[sign - 1] != 'E' && text[sign - 1] != 'e')
    text.insert(sign, 1, 'E');
  return parse_number(text);
}

class BulkData {
 public:
  explicit BulkData(std::string file) : where_{file}, mesh_(std::move(file)) {}

  MeshData read(std::istream& in) {
    for (std::string line; std::getline(in, line);) {
      ++where_.line;
      std::replace(line.begin(), line.end(), '\t', ' ');
      const std::string_view text = std::string_view(line).substr(0, line.find('$'));
      if (trimmed(text).empty()) continue;
      if (in_capitals(text).starts_with("ENDDATA")) break;
      add_line(text);
    }
    take(card_);
    add_ranges();
    return mesh_.mesh();
  }

 private:
  /// A line without a word, or with one that begins with + or *, goes on with the card before it.
  void add_line(std::string_view line) {
    std::vector<std::string> fields = fields_of(line);
    std::string word = in_capitals(fields.front());
    fields.erase(fields.begin());
    if (fields.size() > 8) fields.resize(8);  // the tenth field names the line that goes on
    if (word.empty() || word.front() == '+' || word.front() == '*') {
      // Fields left out at the end of a line keep their places.
      const std::size_t per_line = is_large_ ? 4 : 8;
      card_.fields.resize((card_.fields.size() + per_line - 1) / per_line * per_line);
      card_.fields.insert(card_.fields.end(), fields.begin(), fields.end());
      return;
    }
    take(card_);
    is_large_ = word.ends_with('*');
    if (is_large_) word.pop_back();
    card_ = {word, std::move(fields), where_.line};
  }

  void take(const Card& card) {
    if (card.word == "INCLUDE" || card.word.starts_with("INCLUDE "))
      throw InputError({where_.file, card.line},
                       "data in another file is not read; put it into this one");
    if (card.word == "GRDSET") return refuse_system(card);
    if (card.word == "GRID") return add_node(card);
    if (card.word == "SPC1") return add_constraint(card, 2);
    if (card.word == "SPC") return add_constraint(card, 1);
    for (const NastranCell& cell : kNastranCells)
      if (cell.word == card.word) return add_cell(card, cell);
    for (const char* const second : {"CTRIA6", "CQUAD8"})
      if (card.word == second) refuse_second_order({where_.file, card.line}, card.word);
  }

  std::string_view field(const Card& card, std::size_t k) const {
    return k < card.fields.size() ? std::string_view(card.fields[k]) : std::string_view();
  }

  std::int64_t whole(const Card& card, std::size_t k, const char* expected) const {
    const std::optional<std::int64_t> value = parse_long(field(card, k));
    if (!value)
      throw InputError({where_.file, card.line},
                       fmt::format("field {} of {} is {}, expected {}", k + 2, card.word,
                                   in_ticks(field(card, k)), expected));
    return *value;
  }

  /// GRID, and GRDSET, which stands for the fields that GRID leaves out.
  void refuse_system(const Card& card) const {
    if (!field(card, 1).empty() && field(card, 1) != "0")
      throw InputError({where_.file, card.line},
                       "nodes have a coordinate system of their own; expected the basic one (0)");
  }

  void add_node(const Card& card) {
    const std::int64_t number = whole(card, 0, "a node's number");
    refuse_system(card);
    Eigen::Vector3d x;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string text(field(card, 2 + i));
      const std::optional<double> value = text.empty() ? 0.0 : nastran_number(text);
      if (!value)
        throw InputError(
            {where_.file, card.line},
            fmt::format("field {} of GRID is {}, expected a coordinate", 4 + i, in_ticks(text)));
      x[static_cast<Eigen::Index>(i)] = *value;
    }
    mesh_.add_node(number, x, card.line);
    numbers_.push_back(number);
  }

  void add_cell(const Card& card, const NastranCell& kind) {
    const auto corners = static_cast<std::size_t>(num_corners(kind.shape));
    std::vector<std::int64_t> nodes;
    for (std::size_t a = 0; a < corners; ++a)
      nodes.push_back(whole(card, 2 + a, "a node's number"));
    if (is_solid(kind.shape))
      for (std::size_t k = 2 + corners; k < card.fields.size(); ++k)
        if (!card.fields[k].empty() && card.fields[k].front() != '+')
          refuse_second_order({where_.file, card.line},
                              fmt::format("{} with more than {} nodes", card.word, corners));
    const std::size_t cell = mesh_.add_cell(kind.shape, nodes, card.line);
    if (!field(card, 1).empty())
      mesh_.add_cell_to_set(fmt::format("{} {}", kind.set, whole(card, 1, "a property's number")),
                            cell);
  }

  /// SPC1: nodes from `first` on, with "THRU"; SPC: a node, its freedoms and value, twice.
  void add_constraint(const Card& card, std::size_t first) {
    const std::string set = fmt::format("spc {}", whole(card, 0, "a set's number"));
    if (card.word == "SPC") {
      for (std::size_t k = first; k < card.fields.size(); k += 3)
        if (!field(card, k).empty())
          mesh_.add_node_to_set(set, whole(card, k, "a node's number"), card.line);
      return;
    }
    for (std::size_t k = first; k < card.fields.size(); ++k) {
      if (field(card, k).empty() || field(card, k).front() == '+') continue;
      const std::int64_t from = whole(card, k, "a node's number");
      if (in_capitals(field(card, k + 1)) != "THRU") {
        mesh_.add_node_to_set(set, from, card.line);
        continue;
      }
      ranges_.push_back({set, from, whole(card, k + 2, "a node's number"), card.line});
      k += 2;
    }
  }

  /// Nodes from one number to another, of which some may not be there.
  struct NodeRange {
    std::string set;
    std::int64_t from, to;
    int line;
  };

  void add_ranges() {
    std::sort(numbers_.begin(), numbers_.end());
    for (const NodeRange& range : ranges_)
      for (auto number = std::lower_bound(numbers_.begin(), numbers_.end(), range.from);
           number != numbers_.end() && *number <= range.to; ++number)
        mesh_.add_node_to_set(range.set, *number, range.line);
  }

  Location where_;
  Card card_;
  bool is_large_ = false;
  NumberedMesh mesh_;
  std::vector<std::int64_t> numbers_;  // of nodes
  std::vector<NodeRange> ranges_;
};

}  // namespace

MeshData read_nastran(const std::filesystem::path& file) {
  std::ifstream in(file);
  return BulkData(file.string()).read(in);
}

}  // namespace articular::sim
