#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <sstream>

#include "sim/base/error.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/number_type.hpp"

namespace articular::sim {
namespace {

enum class Encoding { Text, LittleEndian, BigEndian };

/// Of size 0 where there is no such type.
NumberType number_type(const std::string& name) {
  using enum NumberType::Kind;
  if (name == "char" || name == "int8") return {1, Signed};
  if (name == "uchar" || name == "uint8") return {1, Unsigned};
  if (name == "short" || name == "int16") return {2, Signed};
  if (name == "ushort" || name == "uint16") return {2, Unsigned};
  if (name == "int" || name == "int32") return {4, Signed};
  if (name == "uint" || name == "uint32") return {4, Unsigned};
  if (name == "float" || name == "float32") return {4, Real};
  if (name == "double" || name == "float64") return {8, Real};
  return {};
}

struct Property {
  std::string name;
  NumberType count;  // of a list; size 0: a single number
  NumberType value;
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

class PlyFile {
 public:
  explicit PlyFile(const std::filesystem::path& file)
      : file_(file.string()),
        in_(file_, std::ios::binary),
        num_bytes_(std::filesystem::file_size(file)) {}

  MeshData read() {
    read_header();
    for (const Element& element : elements_)
      for (std::int64_t i = 0; i < element.count; ++i) read_element(element);
    MeshData mesh;
    mesh.X = Eigen::Map<const Positions>(coordinates_.data(), 3,
                                         static_cast<Eigen::Index>(coordinates_.size() / 3));
    mesh.triangles = Eigen::Map<const Triangles>(corners_.data(), 3,
                                                 static_cast<Eigen::Index>(corners_.size() / 3));
    return mesh;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError({file_}, "not readable as .ply: " + what);
  }

  void read_header() {
    std::string line;
    if (!std::getline(in_, line) || trimmed(line) != "ply") fail("the first line is not `ply`");
    bool has_layout = false;
    while (std::getline(in_, line)) {
      std::istringstream words{std::string(trimmed(line))};
      std::string word, name;
      words >> word;
      if (word == "end_header") break;
      if (word == "format") {
        words >> name;
        has_layout =
            name == "ascii" || name == "binary_little_endian" || name == "binary_big_endian";
        layout_ = name == "ascii"                  ? Encoding::Text
                  : name == "binary_little_endian" ? Encoding::LittleEndian
                                                   : Encoding::BigEndian;
      } else if (word == "element") {
        Element element;
        if (!(words >> element.name >> element.count) || element.count < 0)
          fail("`" + one_line(line) + "` is not an element with its count");
        if (static_cast<std::uint64_t>(element.count) > num_bytes_)
          fail("it claims " + std::to_string(element.count) + " of `" + one_line(element.name) +
               "`, which is more than it has bytes");
        elements_.push_back(element);
      } else if (word == "property") {
        if (elements_.empty()) fail("a property stands before any element");
        elements_.back().properties.push_back(property(words, line));
      }
    }
    if (!in_) fail("the header has no end");
    if (!has_layout) fail("the header has no known format");
  }

  Property property(std::istringstream& words, const std::string& line) const {
    Property result;
    std::string type;
    words >> type;
    if (type == "list") {
      words >> type;
      result.count = number_type(type);
      if (result.count.size == 0 || result.count.kind == NumberType::Kind::Real)
        fail("`" + one_line(line) + "` is not a list");
      words >> type;
    }
    result.value = number_type(type);
    if (result.value.size == 0 || !(words >> result.name))
      fail("`" + one_line(line) + "` is not a property");
    return result;
  }

  double read_number(const NumberType& type) {
    if (layout_ == Encoding::Text) {
      std::string word;
      in_ >> word;
      const std::optional<double> value = parse_number(word);
      if (!value)
        fail(word.empty() ? "it ends too early"
                          : "`" + one_line(word) + "` is not a finite number");
      return *value;
    }
    std::array<char, 8> bytes{};
    if (!in_.read(bytes.data(), static_cast<std::streamsize>(type.size))) fail("it ends too early");
    return number_from(bytes.data(), type,
                       layout_ == Encoding::BigEndian ? std::endian::big : std::endian::little);
  }

  void read_element(const Element& element) {
    Vec3 position = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  // if x, y, z miss
    for (const Property& property : element.properties) {
      if (property.count.size > 0) {
        const bool is_face = element.name == "face" &&
                             (property.name == "vertex_indices" || property.name == "vertex_index");
        read_list(property, is_face);
        continue;
      }
      const double value = read_number(property.value);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
        position[property.name[0] - 'x'] = value;
    }
    if (element.name == "vertex")
      coordinates_.insert(coordinates_.end(), position.begin(), position.end());
  }

  void read_list(const Property& property, bool is_face) {
    const double count = read_number(property.count);
    std::vector<int> polygon;
    for (std::uint64_t i = 0; static_cast<double>(i) < count; ++i) {
      const double value = read_number(property.value);
      if (!is_face) continue;
      if (value < 0 || value > std::numeric_limits<int>::max() || value != std::floor(value))
        fail("a face has a corner that is no vertex number");
      polygon.push_back(static_cast<int>(value));
    }
    for (std::size_t a = 2; a < polygon.size(); ++a)
      corners_.insert(corners_.end(), {polygon[0], polygon[a - 1], polygon[a]});
  }

  std::string file_;
  std::ifstream in_;
  std::uint64_t num_bytes_;
  Encoding layout_ = Encoding::Text;
  std::vector<Element> elements_;
  std::vector<double> coordinates_;
  std::vector<int> corners_;
};

}  // namespace

MeshData read_ply(const std::filesystem::path& file) { return PlyFile(file).read(); }

}  // namespace articular::sim
