#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/mesh/number_type.hpp"

namespace articular::sim {

/// How a .vtu or .vtp holds its arrays, as its head says.
struct VtkXmlEncoding {
  enum class Compressor { None, Zlib, Lz4, Lzma };

  std::string file, format;  // for messages: the path, and ".vtu"
  std::endian order = std::endian::little;
  NumberType count{4, NumberType::Kind::Unsigned};  // of the sizes in front of data
  Compressor compressor = Compressor::None;
  std::string_view appended;  // behind its "_"
  bool appended_is_base64 = false;

  /// @throws InputError "not readable as .vtu: ..."
  [[noreturn]] void fail(const std::string& what) const;
};

/// An array of a file before it is decoded.
struct VtkXmlArray {
  enum class Place { Text, Base64, Appended };

  std::string name;
  NumberType type;
  bool holds_texts = false;  // strings, in which each byte is a number of a character
  std::uint64_t components = 1;
  Place place = Place::Text;
  std::string content;       // where it is not appended
  std::uint64_t offset = 0;  // in what is appended
};

/// Numbers, as they lay in the file: an array of many small ones takes no more memory than it has
/// bytes.
struct Numbers {
  NumberType type;
  std::string bytes;
  std::endian order = std::endian::native;

  std::size_t size() const { return type.size == 0 ? 0 : bytes.size() / type.size; }
  double operator[](std::size_t i) const {
    return number_from(bytes.data() + i * type.size, type, order);
  }
};

/// How many bytes all arrays of a file may have together. No compressor makes less than a
/// thousandth of data, so a file that claims more than that is damaged, or made to take the memory.
class VtkXmlBudget {
 public:
  explicit VtkXmlBudget(std::uint64_t bytes_of_file) : left_(kMostPerByte * bytes_of_file) {}
  [[nodiscard]] bool take(std::uint64_t bytes) {
    if (bytes > left_) return false;
    left_ -= bytes;
    return true;
  }

 private:
  static constexpr std::uint64_t kMostPerByte = 1100;  // deflate reaches 1032
  std::uint64_t left_;
};

/// The numbers of an array. Every size that the file claims is held against what it has before
/// memory is taken for it. File format: "VTK XML Formats" in the VTK File Formats documentation.
/// @throws InputError where the array does not hold what it says
Numbers decode(const VtkXmlArray& array, const VtkXmlEncoding& encoding, VtkXmlBudget& budget);

}  // namespace articular::sim
