#include "sim/mesh/vtk_xml_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/base/message_text.hpp"
#include "sim/mesh/xml_events.hpp"

namespace articular::sim {
namespace {

constexpr std::uint64_t kMostPoints = 1ULL << 31;  // nodes have numbers of 32 bits
constexpr std::uint64_t kMostComponents = 1000;
constexpr std::size_t kMostFields = 1000;  // each is looked for among all

/// A part of the grid with the arrays of its sections ("Points", "CellData", ...).
struct Piece {
  std::uint64_t num_points = 0, num_cells = 0;
  std::map<std::string, std::uint64_t, std::less<>> num_of;  // "Polys" and the like
  std::map<std::string, std::vector<VtkXmlArray>, std::less<>> sections;
};

class VtkXmlReader {
 public:
  VtkXmlReader(const std::filesystem::path& file, VtkXmlFields fields) : fields_(fields) {
    encoding_.file = file.string();
    encoding_.format = file.extension().string();
    bytes_ = file_bytes(file);
  }

  VtkXmlContent read() {
    read_xml(encoding_.file, encoding_.format, bytes_,
             {.start = [this](const std::string& name, const XmlAttributes& attributes,
                              std::size_t at) { return begin(name, attributes, at); },
              .text =
                  [this](std::string_view text) {
                    if (array_ != nullptr && within_array_ == 0) array_->content += text;
                  },
              .end = [this](const std::string& name) { end(name); }});
    if (kind_.empty()) fail("it holds no <UnstructuredGrid> and no <PolyData>");
    VtkXmlBudget budget(bytes_.size());
    VtkXmlContent content;
    content.is_grid = kind_ == "UnstructuredGrid";
    for (const Piece& piece : pieces_) add(piece, budget, content);
    expect_whole(content);
    for (const VtkXmlArray& array : field_data_)
      if (array.holds_texts && fields_ == VtkXmlFields::All)
        content.texts.emplace_back(
            array.name, text_at(decode(array, encoding_, budget), 0, "its field data hold"));
    return content;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { encoding_.fail(what); }

  // --- the XML

  XmlNext begin(const std::string& name, const XmlAttributes& attributes, std::size_t at) {
    if (!has_root_) begin_file(name, attributes);
    if (name == "UnstructuredGrid" || name == "PolyData") {
      if (!kind_.empty()) fail("it holds two data sets");
      kind_ = name;
    } else if (name == "Piece" && !kind_.empty()) {
      begin_piece(attributes);
    } else if (name == "DataArray" || name == "Array") {
      begin_array(attributes);
    } else if (name == "AppendedData") {
      begin_appended(attributes, at);
      return XmlNext::Stop;  // what follows is no XML where it is raw
    } else if (array_ != nullptr) {
      ++within_array_;  // a remark of VTK's on the array
    } else {
      section_ = name;
    }
    return XmlNext::Continue;
  }

  void end(const std::string& name) {
    if (name == "DataArray" || name == "Array")
      array_ = nullptr;
    else if (array_ != nullptr)
      --within_array_;
    else if (name == "Piece")
      in_piece_ = false;
  }

  void begin_file(const std::string& name, const XmlAttributes& attributes) {
    has_root_ = true;
    if (name != "VTKFile") fail("its root is not <VTKFile>");
    const std::string type = attribute(attributes, "type");
    if (type != "UnstructuredGrid" && type != "PolyData")
      fail("it is a VTKFile of type `" + one_line(type.substr(0, 40)) +
           "`; expected UnstructuredGrid or PolyData");
    const std::string order = attribute(attributes, "byte_order", "LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian")
      fail("its byte_order is neither LittleEndian nor BigEndian");
    encoding_.order = order == "BigEndian" ? std::endian::big : std::endian::little;
    const std::string count = attribute(attributes, "header_type", "UInt32");
    if (count != "UInt32" && count != "UInt64")
      fail("its header_type is neither UInt32 nor UInt64");
    encoding_.count.size = count == "UInt64" ? 8 : 4;
    const std::string compressor = attribute(attributes, "compressor");
    using enum VtkXmlEncoding::Compressor;
    encoding_.compressor = compressor == "vtkZLibDataCompressor"   ? Zlib
                           : compressor == "vtkLZ4DataCompressor"  ? Lz4
                           : compressor == "vtkLZMADataCompressor" ? Lzma
                                                                   : None;
    if (encoding_.compressor == None && !compressor.empty())
      fail("unknown compressor `" + one_line(compressor.substr(0, 40)) + "`");
  }

  std::uint64_t whole_number(const XmlAttributes& attributes, const char* name,
                             std::uint64_t otherwise) const {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return otherwise;
    const std::string_view text = trimmed(found->second);
    std::uint64_t value = 0;
    const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc() || stop != text.data() + text.size() || value > 1ULL << 60)
      fail(std::string(name) + "=\"" + one_line(text.substr(0, 40)) +
           "\" is not a number that counts something");
    return value;
  }

  void begin_piece(const XmlAttributes& attributes) {
    Piece piece;
    piece.num_points = whole_number(attributes, "NumberOfPoints", 0);
    piece.num_cells = whole_number(attributes, "NumberOfCells", 0);
    for (const char* const name : {"Verts", "Lines", "Strips", "Polys"})
      piece.num_of[name] = whole_number(attributes, (std::string("NumberOf") + name).c_str(), 0);
    pieces_.push_back(std::move(piece));
    in_piece_ = true;
    section_.clear();
  }

  NumberType number_type(const std::string& name) const {
    using enum NumberType::Kind;
    static const std::map<std::string, NumberType, std::less<>> types = {
        {"Int8", {1, Signed}},     {"UInt8", {1, Unsigned}},  {"Int16", {2, Signed}},
        {"UInt16", {2, Unsigned}}, {"Int32", {4, Signed}},    {"UInt32", {4, Unsigned}},
        {"Int64", {8, Signed}},    {"UInt64", {8, Unsigned}}, {"Float32", {4, Real}},
        {"Float64", {8, Real}},    {"String", {1, Signed}}};
    const auto found = types.find(name);
    if (found == types.end())
      fail("unknown type of numbers `" + one_line(name.substr(0, 40)) + "`");
    return found->second;
  }

  void begin_array(const XmlAttributes& attributes) {
    VtkXmlArray array;
    array.name = attribute(attributes, "Name");
    const std::string type = attribute(attributes, "type");
    array.type = number_type(type);
    array.holds_texts = type == "String";
    array.components = whole_number(attributes, "NumberOfComponents", 1);
    if (array.components < 1 || array.components > kMostComponents)
      fail("an array has " + std::to_string(array.components) + " components; expected 1 to " +
           std::to_string(kMostComponents));
    const std::string format = attribute(attributes, "format", "ascii");
    array.place = format == "ascii"    ? VtkXmlArray::Place::Text
                  : format == "binary" ? VtkXmlArray::Place::Base64
                                       : VtkXmlArray::Place::Appended;
    if (array.place == VtkXmlArray::Place::Appended && format != "appended")
      fail("an array is neither ascii nor binary nor appended");
    array.offset = whole_number(attributes, "offset", 0);
    std::vector<VtkXmlArray>& arrays = in_piece_ ? pieces_.back().sections[section_] : field_data_;
    arrays.push_back(std::move(array));
    array_ = &arrays.back();
    within_array_ = 0;
  }

  void begin_appended(const XmlAttributes& attributes, std::size_t at) {
    const std::string encoding = attribute(attributes, "encoding", "base64");
    if (encoding != "raw" && encoding != "base64")
      fail("its appended data are neither raw nor base64");
    encoding_.appended_is_base64 = encoding == "base64";
    const std::size_t tag_end = bytes_.find('>', at), data = bytes_.find('_', tag_end);
    if (data == std::string::npos) fail("its appended data do not begin with `_`");
    encoding_.appended = std::string_view(bytes_).substr(data + 1);
    if (encoding_.appended_is_base64)
      encoding_.appended = encoding_.appended.substr(0, encoding_.appended.find('<'));
  }

  // --- the data

  const VtkXmlArray* find(const Piece& piece, const char* section, std::string_view name) const {
    const auto found = piece.sections.find(section);
    if (found == piece.sections.end()) return nullptr;
    for (const VtkXmlArray& array : found->second)
      if (name.empty() || array.name == name) return &array;
    return nullptr;
  }

  Numbers numbers(const Piece& piece, const char* section, std::string_view name,
                  VtkXmlBudget& budget) const {
    const VtkXmlArray* const array = find(piece, section, name);
    if (array == nullptr)
      fail(std::string("<") + section + "> holds no array" +
           (name.empty() ? "" : " `" + std::string(name) + "`"));
    return decode(*array, encoding_, budget);
  }

  /// Each field is there once, and in every piece. Of a mesh, points have fields that nobody may
  /// have asked for: others are dropped.
  void expect_whole(VtkXmlContent& content) const {
    const std::size_t num_points = content.points.size() / 3,
                      num_cells = content.cells.begin.size() + content.vertices.begin.size() +
                                  content.lines.begin.size() + content.strips.begin.size() +
                                  content.polygons.begin.size() - 5;
    const auto expect = [&](const std::vector<VtkXmlField>& fields, std::size_t tuples) {
      for (const VtkXmlField& field : fields)
        if (field.values.size() != tuples * field.components)
          fail("`" + one_line(field.name) + "` is there twice, or not in all pieces");
    };
    if (fields_ == VtkXmlFields::OfMeshes)
      std::erase_if(content.point_fields, [num_points](const VtkXmlField& field) {
        return field.values.size() != num_points;
      });
    expect(content.point_fields, num_points);
    expect(content.cell_fields, num_cells);
  }

  void expect_size(const Numbers& numbers, std::uint64_t tuples, std::uint64_t components,
                   const std::string& of) const {
    if (numbers.size() % components != 0 || numbers.size() / components != tuples)
      fail("there are " + std::to_string(numbers.size()) + " numbers for " + of + "; expected " +
           std::to_string(tuples) + " times " + std::to_string(components));
  }

  std::vector<std::int64_t> whole_numbers(const Numbers& numbers, const std::string& of) const {
    std::vector<std::int64_t> values(numbers.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double value = numbers[i];
      if (!(std::abs(value) < 1e15) || value != std::floor(value))
        fail("a number for " + of + " is no whole number");
      values[i] = static_cast<std::int64_t>(value);
    }
    return values;
  }

  void add(const Piece& piece, VtkXmlBudget& budget, VtkXmlContent& content) const {
    const auto first_point = static_cast<std::int64_t>(content.points.size() / 3);
    if (piece.num_points >= kMostPoints - static_cast<std::uint64_t>(first_point))
      fail("it has more points than 32 bits can number");
    if (piece.num_points > 0) {
      const Numbers points = numbers(piece, "Points", "", budget);
      expect_size(points, piece.num_points, 3, "points");
      for (std::size_t i = 0; i < points.size(); ++i) content.points.push_back(points[i]);
    }
    std::uint64_t num_cells = piece.num_cells;
    if (content.is_grid) {
      add_cells(piece, "Cells", num_cells, first_point, budget, content.cells);
      add_types(piece, budget, content);
    } else {
      num_cells = 0;
      for (const auto& [section, cells] :
           {std::pair{"Verts", &content.vertices}, std::pair{"Lines", &content.lines},
            std::pair{"Strips", &content.strips}, std::pair{"Polys", &content.polygons}}) {
        const std::uint64_t count = piece.num_of.find(section)->second;
        add_cells(piece, section, count, first_point, budget, *cells);
        num_cells += count;
      }
    }
    add_fields(piece, "PointData", piece.num_points, budget, content.point_fields);
    add_fields(piece, "CellData", num_cells, budget, content.cell_fields);
    if (fields_ == VtkXmlFields::All) add_cell_texts(piece, num_cells, budget, content.cell_texts);
  }

  void add_cells(const Piece& piece, const char* section, std::uint64_t count,
                 std::int64_t first_point, VtkXmlBudget& budget, VtkXmlCells& cells) const {
    if (count == 0) return;
    const std::vector<std::int64_t> ends =
        whole_numbers(numbers(piece, section, "offsets", budget), "offsets of cells");
    const std::vector<std::int64_t> nodes =
        whole_numbers(numbers(piece, section, "connectivity", budget), "cells");
    if (ends.size() != count)
      fail("it claims " + std::to_string(count) + " cells and has offsets of " +
           std::to_string(ends.size()));
    if (!std::is_sorted(ends.begin(), ends.end()) || ends.front() < 0 ||
        ends.back() != static_cast<std::int64_t>(nodes.size()))
      fail("the cells' offsets do not ascend to the number of their points");
    const std::int64_t before = cells.begin.back();
    for (const std::int64_t end : ends) cells.begin.push_back(before + end);
    for (const std::int64_t node : nodes) {
      if (node < 0 || node >= static_cast<std::int64_t>(piece.num_points))
        fail("a cell refers to point " + std::to_string(node) + ", but there are " +
             std::to_string(piece.num_points) + " points");
      cells.nodes.push_back(first_point + node);
    }
  }

  void add_types(const Piece& piece, VtkXmlBudget& budget, VtkXmlContent& content) const {
    if (piece.num_cells == 0) return;
    const Numbers types = numbers(piece, "Cells", "types", budget);
    expect_size(types, piece.num_cells, 1, "types of cells");
    for (const std::int64_t type : whole_numbers(types, "types of cells"))
      content.types.push_back(static_cast<int>(std::clamp<std::int64_t>(type, -1, 1000)));
  }

  bool is_wanted(const VtkXmlArray& array, bool of_cells) const {
    if (fields_ == VtkXmlFields::All) return true;
    return of_cells ? array.components == 3
                    : array.components == 1 && array.type.kind != NumberType::Kind::Real;
  }

  void add_fields(const Piece& piece, const char* section, std::uint64_t tuples,
                  VtkXmlBudget& budget, std::vector<VtkXmlField>& fields) const {
    const auto found = piece.sections.find(section);
    if (found == piece.sections.end()) return;
    for (const VtkXmlArray& array : found->second) {
      if (!is_wanted(array, section == std::string_view("CellData")) || array.holds_texts ||
          array.name.empty())
        continue;
      const Numbers values = decode(array, encoding_, budget);
      expect_size(values, tuples, array.components, "`" + one_line(array.name) + "`");
      VtkXmlField& field = named(array.name, "fields", fields);
      field.components = array.components;
      for (std::size_t i = 0; i < values.size(); ++i) field.values.push_back(values[i]);
    }
  }

  /// An entry of `all` by its name; a new one where there is none. @param what  they are
  template <class Named>
  Named& named(const std::string& name, const char* what, std::vector<Named>& all) const {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
    if (found != all.end()) return *found;
    if (all.size() == kMostFields)
      fail("it has more than " + std::to_string(kMostFields) + " " + what);
    all.emplace_back().name = name;
    return all.back();
  }

  void add_cell_texts(const Piece& piece, std::uint64_t num_cells, VtkXmlBudget& budget,
                      std::vector<VtkXmlTexts>& all) const {
    const auto found = piece.sections.find("CellData");
    if (found == piece.sections.end()) return;
    for (const VtkXmlArray& array : found->second) {
      if (!array.holds_texts || array.name.empty()) continue;
      const Numbers characters = decode(array, encoding_, budget);
      std::vector<std::string>& texts = named(array.name, "texts of cells", all).texts;
      std::uint64_t count = 0;
      for (std::size_t at = 0; at < characters.size(); at += texts.back().size() + 1, ++count)
        texts.push_back(text_at(characters, at, "its cells have"));
      if (count != num_cells)
        fail("`" + one_line(array.name) + "` has " + std::to_string(count) + " texts for " +
             std::to_string(num_cells) + " cells");
    }
  }

  /// Texts stand one behind the other, each with a zero at its end.
  std::string text_at(const Numbers& characters, std::size_t at, const char* who) const {
    std::string text;
    for (std::size_t i = at; i < characters.size() && characters[i] != 0; ++i) {
      if (!(characters[i] >= -128 && characters[i] <= 255))
        fail(std::string(who) + " a text with a number that is no character");
      text += static_cast<char>(static_cast<int>(characters[i]));
    }
    return text;
  }

  VtkXmlFields fields_;
  std::string bytes_;
  VtkXmlEncoding encoding_;
  std::string kind_;     // "UnstructuredGrid" or "PolyData", once it has begun
  std::string section_;  // the element that holds the arrays
  bool has_root_ = false, in_piece_ = false;
  std::vector<Piece> pieces_;
  std::vector<VtkXmlArray> field_data_;  // of the whole file
  VtkXmlArray* array_ = nullptr;         // whose content is read
  int within_array_ = 0;                 // elements that are open in it
};

}  // namespace

VtkXmlContent read_vtk_xml(const std::filesystem::path& file, VtkXmlFields fields) {
  return VtkXmlReader(file, fields).read();
}

}  // namespace articular::sim
