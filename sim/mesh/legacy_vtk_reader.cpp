#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/mesh/cell_collector.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/mesh_sets.hpp"
#include "sim/mesh/number_type.hpp"
#include "sim/mesh/white_space.hpp"

namespace articular::sim {
namespace {

constexpr std::uint64_t kMostNodes = 1ULL << 31;  // nodes have numbers of 32 bits

struct NamedType {
  const char* name;
  NumberType type;
};

using enum NumberType::Kind;
constexpr NumberType kInt{4, Signed}, kByte{1, Unsigned}, kFloat{4, Real};
constexpr NamedType kNumberTypes[] = {{"char", {1, Signed}},
                                      {"signed_char", {1, Signed}},
                                      {"unsigned_char", kByte},
                                      {"short", {2, Signed}},
                                      {"unsigned_short", {2, Unsigned}},
                                      {"int", kInt},
                                      {"unsigned_int", {4, Unsigned}},
                                      {"long", {8, Signed}},
                                      {"unsigned_long", {8, Unsigned}},
                                      {"vtkidtype", kInt},
                                      {"vtktypeint64", {8, Signed}},
                                      {"vtktypeuint64", {8, Unsigned}},
                                      {"float", kFloat},
                                      {"double", {8, Real}}};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// The file format is described in the "VTK File Formats" chapter of the VTK User's Guide. What a
/// file claims to hold is held against what is left of it before any memory is taken.
class LegacyVtkFile {
 public:
  explicit LegacyVtkFile(const std::filesystem::path& file)
      : file_(file.string()), bytes_(file_bytes(file)), cells_(file_) {}

  MeshData read() {
    read_header();
    for (std::string section = word(); !section.empty(); section = word()) read_section(section);
    return mesh();
  }

 private:
  enum class Data { None, Points, Cells };

  [[noreturn]] void fail(const std::string& what) const {
    Location where{file_};
    if (is_text_)
      where.line =
          1 + static_cast<int>(std::count(bytes_.begin(),
                                          bytes_.begin() + static_cast<std::ptrdiff_t>(at_), '\n'));
    throw InputError(where, "not readable as .vtk: " + what);
  }

  std::size_t left() const { return bytes_.size() - at_; }

  std::string_view line() {
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view text = std::string_view(bytes_).substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    return text;
  }

  /// "" at the end of the file.
  std::string_view word_view() {
    while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
    return std::string_view(bytes_).substr(begin, at_ - begin);
  }
  std::string word() { return lower(word_view()); }

  /// A count that the file gives of what it holds.
  std::uint64_t count(const char* of) {
    const std::string_view text = word_view();
    const std::optional<double> value = parse_number(text);
    if (!value || *value < 0 || *value != std::floor(*value))
      fail(std::string("expected the number of ") + of + ", found `" + one_line(text) + "`");
    if (*value > static_cast<double>(bytes_.size()))
      fail("claims " + one_line(text) + " " + of + ", which is more than it has bytes");
    return static_cast<std::uint64_t>(*value);
  }

  NumberType number_type() {
    const std::string name = word();
    for (const NamedType& known : kNumberTypes)
      if (name == known.name) return known.type;
    fail("unknown type of numbers `" + one_line(name) + "`");
  }

  /// Where the numbers of an array begin: behind the end of the line that names them.
  void begin_numbers(std::uint64_t how_many, const NumberType& type, const char* of) {
    if (!is_text_) line();
    const std::uint64_t least = is_text_ ? how_many : how_many * type.size;
    if (least > left() + 1)
      fail("ends before the last of its " + std::to_string(how_many) + " numbers for " + of);
  }

  double number(const NumberType& type) {
    if (is_text_) {
      const std::string_view text = word_view();
      double value = 0;  // may be nan, in data that nobody asks for
      const char* const end = text.data() + text.size();
      const auto [stop, status] =
          std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), end, value);
      if (status != std::errc() || stop != end)
        fail(text.empty() ? "it ends too early" : "`" + one_line(text) + "` is not a number");
      return value;
    }
    if (left() < type.size) fail("it ends too early");
    const double value = number_from(bytes_.data() + at_, type, std::endian::big);
    at_ += type.size;
    return value;
  }

  std::vector<double> numbers(std::uint64_t how_many, const NumberType& type, const char* of) {
    begin_numbers(how_many, type, of);
    std::vector<double> values(how_many);
    for (double& value : values) value = number(type);
    return values;
  }

  std::vector<std::int64_t> integers(std::uint64_t how_many, const NumberType& type,
                                     const char* of) {
    begin_numbers(how_many, type, of);
    std::vector<std::int64_t> values(how_many);
    for (std::int64_t& value : values) {
      const double given = number(type);
      if (!(std::abs(given) < 1e15) || given != std::floor(given))
        fail(std::string("a number for ") + of + " is no whole number");
      value = static_cast<std::int64_t>(given);
    }
    return values;
  }

  void read_header() {
    if (!line().starts_with("# vtk DataFile Version"))
      fail("its first line is not `# vtk DataFile Version ...`");
    line();  // a title
    const std::string format = word();
    if (format != "ascii" && format != "binary") fail("its third line is not ASCII or BINARY");
    is_text_ = format == "ascii";
    if (word() != "dataset") fail("expected DATASET");
    const std::string kind = word();
    is_grid_ = kind == "unstructured_grid";
    if (!is_grid_ && kind != "polydata")
      fail("expected DATASET UNSTRUCTURED_GRID or POLYDATA, found `" + one_line(kind) + "`");
  }

  void read_section(const std::string& section) {
    if (section == "points")
      read_points();
    else if (section == "cells" && is_grid_)
      connectivity_ = read_cells();
    else if (section == "cell_types" && is_grid_)
      types_ = integers(count("cells"), kInt, "types of cells");
    else if (section == "polygons" && !is_grid_)
      add(vtk_cell::kPolygon, read_cells());
    else if (section == "triangle_strips" && !is_grid_)
      add(vtk_cell::kTriangleStrip, read_cells());
    else if ((section == "vertices" || section == "lines") && !is_grid_)
      read_cells();
    else if (section == "point_data" || section == "cell_data")
      begin_data(section == "cell_data" ? Data::Cells : Data::Points);
    else if (section == "metadata")
      skip_metadata();
    else if (section == "field")
      read_field();
    else
      read_attribute(section);
  }

  void read_points() {
    const std::uint64_t how_many = count("points");
    if (how_many >= kMostNodes) fail("has more points than 32 bits can number");
    points_ = numbers(3 * how_many, number_type(), "points");
  }

  /// By cell: where it begins in the nodes, and one more.
  struct Connectivity {
    std::vector<std::int64_t> begin, nodes;
  };

  Connectivity read_cells() {
    const std::uint64_t first = count("cells"), second = count("numbers of cells");
    const std::size_t before = at_;
    if (word() == "offsets") return read_offsets(first, second);  // since version 5
    at_ = before;
    const std::vector<std::int64_t> list = integers(second, kInt, "cells");
    Connectivity cells;
    cells.begin.push_back(0);
    for (std::size_t i = 0; i < list.size();) {
      const std::int64_t size = list[i++];
      if (size < 0 || static_cast<std::uint64_t>(size) > list.size() - i)
        fail("a cell claims " + std::to_string(size) + " points, and " +
             std::to_string(list.size() - i) + " numbers are left");
      const auto corners = list.begin() + static_cast<std::ptrdiff_t>(i);
      cells.nodes.insert(cells.nodes.end(), corners, corners + size);
      cells.begin.push_back(static_cast<std::int64_t>(cells.nodes.size()));
      i += static_cast<std::size_t>(size);
    }
    if (cells.begin.size() - 1 != first)
      fail("claims " + std::to_string(first) + " cells, and holds " +
           std::to_string(cells.begin.size() - 1));
    return cells;
  }

  Connectivity read_offsets(std::uint64_t num_offsets, std::uint64_t num_nodes) {
    Connectivity cells;
    NumberType type = number_type();
    cells.begin = integers(num_offsets, type, "offsets of cells");
    if (word() != "connectivity") fail("expected CONNECTIVITY");
    type = number_type();
    cells.nodes = integers(num_nodes, type, "cells");
    if (cells.begin.empty()) cells.begin.push_back(0);
    if (cells.begin.front() != 0 || cells.begin.back() != static_cast<std::int64_t>(num_nodes) ||
        !std::is_sorted(cells.begin.begin(), cells.begin.end()))
      fail("the cells' offsets do not ascend from 0 to the number of their points");
    return cells;
  }

  void add(int type, const Connectivity& cells) {
    for (std::size_t e = 0; e + 1 < cells.begin.size(); ++e)
      cells_.add(type, cells.begin[e + 1] - cells.begin[e], cells.nodes.data() + cells.begin[e]);
  }

  void begin_data(Data data) {
    data_ = data;
    num_tuples_ = count(data == Data::Cells ? "cells with data" : "points with data");
  }

  /// Names of components and the like: lines up to an empty one.
  void skip_metadata() {
    line();
    while (left() > 0) {
      const std::string_view text = line();
      if (std::all_of(text.begin(), text.end(), is_space)) return;
    }
  }

  void read_field() {
    word_view();  // its name
    for (std::uint64_t arrays = count("arrays"); arrays > 0; --arrays) {
      std::string name(word_view());
      if (lower(name) == "metadata") {
        skip_metadata();
        name = word_view();
      }
      const std::uint64_t components = count("components"), tuples = count("values");
      if (components > 0 && tuples > bytes_.size() / components)
        fail("claims more values of `" + one_line(name) + "` than it has bytes");
      const std::size_t before = at_;
      const std::string type = word();
      if (type == "string" || type == "utf8_string") {
        skip_texts(components * tuples);
        continue;
      }
      at_ = before;
      const NumberType type_of_field = number_type();
      keep(name, components, type_of_field, numbers(components * tuples, type_of_field, "a field"));
    }
  }

  /// One a line; in binary files each with its length in front.
  void skip_texts(std::uint64_t how_many) {
    line();
    for (; how_many > 0; --how_many) {
      if (is_text_) {
        if (left() == 0) fail("it ends too early");
        line();
        continue;
      }
      if (left() == 0) fail("it ends too early");
      // The first two bits say how many bytes the length has: 8, 4, 2 or 1.
      const std::size_t size = std::size_t{8} >> (static_cast<unsigned char>(bytes_[at_]) >> 6);
      if (left() < size) fail("it ends too early");
      std::uint64_t length = static_cast<unsigned char>(bytes_[at_]) & 0x3f;
      for (std::size_t i = 1; i < size; ++i)
        length = length << 8 | static_cast<unsigned char>(bytes_[at_ + i]);
      at_ += size;
      if (length > left()) fail("a text claims to be longer than the rest of the file");
      at_ += length;
    }
  }

  /// SCALARS and the like, of points or cells.
  void read_attribute(const std::string& kind) {
    if (data_ == Data::None) fail("unknown section `" + one_line(kind) + "`");
    if (kind == "lookup_table") {
      word_view();
      const std::uint64_t colours = count("colours");
      numbers(4 * colours, is_text_ ? kFloat : kByte, "a table of colours");
      return;
    }
    const std::string name(word_view());
    if (kind == "color_scalars") {
      const std::uint64_t components = count("components");
      check_size(components);
      numbers(components * num_tuples_, is_text_ ? kFloat : kByte, "colours");
      return;
    }
    std::uint64_t components = kind == "vectors" || kind == "normals" ? 3
                               : kind == "tensors"                    ? 9
                               : kind == "tensors6"                   ? 6
                                                                      : 1;
    if (kind == "texture_coordinates") components = count("components");
    if (kind != "scalars" && kind != "texture_coordinates" && components == 1 &&
        kind != "global_ids" && kind != "pedigree_ids" && kind != "edge_flags")
      fail("unknown section `" + one_line(kind) + "`");
    const NumberType type = number_type();
    if (kind == "scalars") components = scalar_components();
    check_size(components);
    keep(name, components, type, numbers(components * num_tuples_, type, "data"));
  }

  /// The rest of the line of SCALARS may say how many; a line that names a table may follow.
  std::uint64_t scalar_components() {
    const std::size_t before = at_;
    const std::string_view rest = line();
    std::uint64_t components = 1;
    if (!std::all_of(rest.begin(), rest.end(), is_space)) {
      at_ = before;
      components = count("components");
      line();
    }
    const std::size_t table = at_;
    if (word() == "lookup_table")
      word_view();
    else
      at_ = table > 0 ? table - 1 : 0;  // the end of the line of SCALARS once more
    return components;
  }

  void check_size(std::uint64_t components) const {
    if (components > 0 && num_tuples_ > bytes_.size() / components)
      fail("claims more data than it has bytes");
  }

  /// Only vectors of cells are asked for, and whole numbers of points.
  void keep(const std::string& name, std::uint64_t components, const NumberType& type,
            std::vector<double> values) {
    if (data_ == Data::Cells && components == 3)
      vectors_.emplace_back(name, std::move(values));
    else if (data_ == Data::Points && components == 1 && type.kind != Real)
      point_numbers_.emplace_back(name, std::move(values));
  }

  MeshData mesh() {
    if (is_grid_) {
      if (types_.size() + 1 != std::max<std::size_t>(connectivity_.begin.size(), 1))
        fail("has types of " + std::to_string(types_.size()) + " cells, and " +
             std::to_string(std::max<std::size_t>(connectivity_.begin.size(), 1) - 1) + " cells");
      for (std::size_t e = 0; e < types_.size(); ++e)
        cells_.add(static_cast<int>(std::clamp<std::int64_t>(types_[e], -1, 1000)),
                   connectivity_.begin[e + 1] - connectivity_.begin[e],
                   connectivity_.nodes.data() + connectivity_.begin[e]);
    }
    MeshData mesh;
    cells_.put_into(mesh);
    mesh.X = Eigen::Map<const Positions>(points_.data(), 3,
                                         static_cast<Eigen::Index>(points_.size() / 3));
    for (const auto& [name, values] : point_numbers_)
      if (values.size() == points_.size() / 3) add_set_of_points(name, values, mesh);
    if (is_grid_)
      for (const auto& [name, values] : vectors_)
        mesh.cell_vectors.emplace_back(name, of_tets(values));
    return mesh;
  }

  /// The columns of the tetrahedra alone.
  Eigen::Matrix3Xd of_tets(const std::vector<double>& values) const {
    if (values.size() != 3 * types_.size())
      fail("has vectors of " + std::to_string(values.size() / 3) + " cells, and " +
           std::to_string(types_.size()) + " cells");
    const Eigen::Map<const Eigen::Matrix3Xd> all(values.data(), 3,
                                                 static_cast<Eigen::Index>(types_.size()));
    std::vector<Eigen::Index> tets;
    for (std::size_t e = 0; e < types_.size(); ++e)
      if (types_[e] == vtk_cell::kTetrahedron) tets.push_back(static_cast<Eigen::Index>(e));
    return all(Eigen::all, tets);
  }

  std::string file_, bytes_;
  std::size_t at_ = 0;
  bool is_text_ = false, is_grid_ = false;
  CellCollector cells_;
  std::vector<double> points_;
  Connectivity connectivity_;        // of a grid
  std::vector<std::int64_t> types_;  // of a grid's cells
  Data data_ = Data::None;           // whose attributes follow
  std::uint64_t num_tuples_ = 0;     // of these
  std::vector<std::pair<std::string, std::vector<double>>> point_numbers_;
  std::vector<std::pair<std::string, std::vector<double>>> vectors_;  // of cells
};

}  // namespace

MeshData read_legacy_vtk(const std::filesystem::path& file) { return LegacyVtkFile(file).read(); }

}  // namespace articular::sim
