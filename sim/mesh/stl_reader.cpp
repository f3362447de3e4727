#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/number_type.hpp"
#include "sim/mesh/white_space.hpp"

namespace articular::sim {
namespace {

constexpr std::size_t kHead = 80, kCount = 4, kTriangle = 50;  // [byte]

/// Corners in the order in which they come first; those at one place are one.
class CornerMerger {
 public:
  int index_of(const Vec3& x) {
    const Vec3 key = x.array() + 0.0;  // -0 is 0
    const auto [place, is_new] =
        indices_.try_emplace({key.x(), key.y(), key.z()}, static_cast<int>(indices_.size()));
    if (is_new) coordinates_.insert(coordinates_.end(), x.begin(), x.end());
    return place->second;
  }
  /// A triangle with a corner twice is left out.
  void add(const std::array<Vec3, 3>& corners) {
    const int a = index_of(corners[0]), b = index_of(corners[1]), c = index_of(corners[2]);
    if (a != b && b != c && c != a) triangles_.insert(triangles_.end(), {a, b, c});
  }
  MeshData mesh() const {
    MeshData mesh;
    mesh.X = Eigen::Map<const Positions>(coordinates_.data(), 3,
                                         static_cast<Eigen::Index>(coordinates_.size() / 3));
    mesh.triangles = Eigen::Map<const Triangles>(triangles_.data(), 3,
                                                 static_cast<Eigen::Index>(triangles_.size() / 3));
    return mesh;
  }

 private:
  std::map<std::array<double, 3>, int> indices_;
  std::vector<double> coordinates_;  // x0 y0 z0 x1 ...
  std::vector<int> triangles_;
};

class StlFile {
 public:
  explicit StlFile(const std::filesystem::path& file)
      : where_{file.string()}, bytes_(file_bytes(file)) {}

  /// Some programs begin binary files with the word of text files, so the length decides first.
  MeshData read() {
    const std::uint64_t count = binary_count();
    if (bytes_.size() >= kHead + kCount && bytes_.size() == kHead + kCount + kTriangle * count)
      return read_binary(count);
    if (trimmed(bytes_).starts_with("solid")) return read_text();
    if (bytes_.size() < kHead + kCount || bytes_.size() < kHead + kCount + kTriangle * count)
      throw InputError(where_,
                       "not readable as .stl: neither text (`solid ...`) nor as long as its " +
                           std::to_string(count) + " triangles");
    return read_binary(count);  // with something behind the last triangle
  }

 private:
  std::uint64_t binary_count() const {
    if (bytes_.size() < kHead + kCount) return 0;
    return static_cast<std::uint64_t>(number_from(
        bytes_.data() + kHead, {kCount, NumberType::Kind::Unsigned}, std::endian::little));
  }

  /// A normal, which is left out, three corners in single precision, and two bytes.
  MeshData read_binary(std::uint64_t count) {
    constexpr NumberType kFloat{4, NumberType::Kind::Real};
    CornerMerger merger;
    for (std::uint64_t t = 0; t < count; ++t) {
      const char* at = bytes_.data() + kHead + kCount + kTriangle * t + 3 * kFloat.size;
      std::array<Vec3, 3> corners;
      for (Vec3& corner : corners)
        for (double& coordinate : corner) {
          coordinate = number_from(at, kFloat, std::endian::little);
          at += kFloat.size;
        }
      merger.add(corners);
    }
    return merger.mesh();
  }

  /// The next word in lower case, "" at the end.
  std::string word() {
    while (at_ < bytes_.size() && is_space(bytes_[at_])) where_.line += bytes_[at_++] == '\n';
    std::string text;
    while (at_ < bytes_.size() && !is_space(bytes_[at_]))
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(bytes_[at_++])));
    return text;
  }

  double coordinate() {
    const std::optional<double> value = parse_number(word());
    if (!value)
      throw InputError(where_, "not readable as .stl: expected three numbers behind `vertex`");
    return *value;
  }

  MeshData read_text() {
    where_.line = 1;
    CornerMerger merger;
    std::array<Vec3, 3> corners;
    std::size_t count = 0;  // corners of the facet so far
    for (std::string text = word(); !text.empty(); text = word()) {
      if (text == "vertex") {
        if (count == 3)
          throw InputError(where_, "not readable as .stl: a facet has more than three corners");
        for (double& x : corners[count]) x = coordinate();
        ++count;
      } else if (text == "endfacet") {
        if (count != 3)
          throw InputError(where_, "not readable as .stl: a facet has " + std::to_string(count) +
                                       " corners; expected three");
        merger.add(corners);
        count = 0;
      }
    }
    if (count != 0) throw InputError(where_, "not readable as .stl: it ends within a facet");
    return merger.mesh();
  }

  Location where_;
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace

MeshData read_stl(const std::filesystem::path& file) { return StlFile(file).read(); }

}  // namespace articular::sim
