#include "sim/mesh/vtk_xml_array.hpp"

#include <lz4.h>
#include <lzma.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/mesh/white_space.hpp"

namespace articular::sim {
namespace {

/// -1: no digit of base64
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Bytes one after the other, out of raw ones or base64.
class ByteSource {
 public:
  ByteSource(std::string_view coded, bool is_base64, const VtkXmlEncoding& encoding)
      : coded_(coded), is_base64_(is_base64), encoding_(encoding) {}

  /// No more than these can come.
  std::uint64_t most_left() const {
    return is_base64_ ? decoded_.size() + coded_.size() / 4 * 3 : coded_.size();
  }

  std::string take(std::uint64_t count) {
    if (count > most_left()) ends_too_early();
    if (!is_base64_) {
      std::string bytes(coded_.substr(0, count));
      coded_.remove_prefix(count);
      return bytes;
    }
    while (decoded_.size() < count) decode_group();
    std::string bytes = decoded_.substr(0, count);
    decoded_.erase(0, count);
    return bytes;
  }

 private:
  [[noreturn]] void ends_too_early() const {
    encoding_.fail("an array claims more bytes than the file has");
  }

  /// Four digits are three bytes, or fewer where the last ones are "=". Data in several parts, each
  /// with such an end, are read as one.
  void decode_group() {
    std::uint32_t bits = 0;
    int digits = 0, padding = 0;
    while (digits + padding < 4) {
      if (coded_.empty()) ends_too_early();
      const char c = coded_.front();
      coded_.remove_prefix(1);
      if (is_space(c)) continue;
      const int digit = base64_digit(c);
      if (c == '=') {
        ++padding;
      } else if (digit < 0 || padding > 0) {
        encoding_.fail("an array is no base64");
      } else {
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        ++digits;
      }
    }
    if (digits < 2) encoding_.fail("an array is no base64");
    bits <<= 6 * padding;
    for (int i = 0; i < digits - 1; ++i) decoded_ += static_cast<char>(bits >> (16 - 8 * i));
  }

  std::string_view coded_;
  bool is_base64_;
  const VtkXmlEncoding& encoding_;
  std::string decoded_;
};

std::uint64_t take_count(ByteSource& source, const VtkXmlEncoding& encoding) {
  const std::string bytes = source.take(encoding.count.size);
  const double count = number_from(bytes.data(), encoding.count, encoding.order);
  if (!(count < 9e15)) encoding.fail("an array claims more bytes than the file has");
  return static_cast<std::uint64_t>(count);
}

/// @return whether the block has just that size
bool uncompress_block(VtkXmlEncoding::Compressor compressor, const std::string& from, char* to,
                      std::size_t size) {
  switch (compressor) {
    case VtkXmlEncoding::Compressor::Zlib: {
      uLongf got = size;
      return ::uncompress(reinterpret_cast<Bytef*>(to), &got,
                          reinterpret_cast<const Bytef*>(from.data()), from.size()) == Z_OK &&
             got == size;
    }
    case VtkXmlEncoding::Compressor::Lz4:
      return from.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max()) &&
             size <= static_cast<std::size_t>(std::numeric_limits<int>::max()) &&
             LZ4_decompress_safe(from.data(), to, static_cast<int>(from.size()),
                                 static_cast<int>(size)) == static_cast<int>(size);
    case VtkXmlEncoding::Compressor::Lzma: {
      constexpr std::uint64_t kMostMemory = std::uint64_t{100} << 20;  // of the strongest preset
      std::uint64_t most = kMostMemory;
      std::size_t read = 0, got = 0;
      return lzma_stream_buffer_decode(
                 &most, 0, nullptr, reinterpret_cast<const std::uint8_t*>(from.data()), &read,
                 from.size(), reinterpret_cast<std::uint8_t*>(to), &got, size) == LZMA_OK &&
             got == size;
    }
    case VtkXmlEncoding::Compressor::None:
      break;
  }
  return false;
}

/// In front: the number of blocks, their size before compression, that of the last one if it is
/// shorter (else 0), and the compressed size of each.
std::string take_compressed(ByteSource& source, const VtkXmlEncoding& encoding,
                            VtkXmlBudget& budget) {
  const std::uint64_t num_blocks = take_count(source, encoding),
                      size = take_count(source, encoding), last = take_count(source, encoding);
  if (num_blocks > source.most_left() / encoding.count.size)
    encoding.fail("an array claims more blocks than the file has");
  if (num_blocks == 0) return {};
  if (last > size) encoding.fail("the last block of an array is larger than the others");
  std::vector<std::uint64_t> compressed(num_blocks);
  for (std::uint64_t& bytes : compressed) bytes = take_count(source, encoding);
  const std::uint64_t whole_blocks = last > 0 ? num_blocks - 1 : num_blocks;
  if (size > 0 && whole_blocks > std::numeric_limits<std::uint64_t>::max() / 2 / size)
    encoding.fail("an array claims more bytes than the file has");
  const std::uint64_t all = whole_blocks * size + last;
  if (!budget.take(all)) encoding.fail("an array claims more bytes than its data can unfold to");
  std::string bytes(all, '\0');
  std::uint64_t at = 0;
  for (std::uint64_t block = 0; block < num_blocks; ++block) {
    const std::uint64_t unfolded = block < whole_blocks ? size : last;
    if (!uncompress_block(encoding.compressor, source.take(compressed[block]), bytes.data() + at,
                          unfolded))
      encoding.fail("the compressed data of an array are damaged");
    at += unfolded;
  }
  return bytes;
}

/// Numbers in words; kept in double precision.
Numbers from_text(const VtkXmlArray& array, const VtkXmlEncoding& encoding, VtkXmlBudget& budget) {
  Numbers numbers{{sizeof(double), NumberType::Kind::Real}, {}};
  std::string_view text = array.content;
  while (true) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    if (text.empty()) return numbers;
    const std::string_view word = text.substr(
        0,
        static_cast<std::size_t>(std::find_if(text.begin(), text.end(), is_space) - text.begin()));
    text.remove_prefix(word.size());
    double value = 0;  // may be nan, in data that nobody asks for
    const char* const end = word.data() + word.size();
    const auto [stop, status] =
        std::from_chars(word.data() + (word.starts_with('+') ? 1 : 0), end, value);
    if (status != std::errc() || stop != end || !budget.take(sizeof value))
      encoding.fail("`" + one_line(word.substr(0, 40)) + "` is not a number");
    numbers.bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
}

}  // namespace

void VtkXmlEncoding::fail(const std::string& what) const {
  throw InputError({file}, "not readable as " + format + ": " + what);
}

Numbers decode(const VtkXmlArray& array, const VtkXmlEncoding& encoding, VtkXmlBudget& budget) {
  if (array.place == VtkXmlArray::Place::Text) return from_text(array, encoding, budget);
  const bool is_appended = array.place == VtkXmlArray::Place::Appended;
  if (is_appended && array.offset > encoding.appended.size())
    encoding.fail("an array begins behind the end of the file");
  ByteSource source(is_appended ? encoding.appended.substr(array.offset) : array.content,
                    !is_appended || encoding.appended_is_base64, encoding);
  Numbers numbers{array.type, {}, encoding.order};
  if (encoding.compressor != VtkXmlEncoding::Compressor::None) {
    numbers.bytes = take_compressed(source, encoding, budget);
  } else {
    const std::uint64_t size = take_count(source, encoding);
    if (!budget.take(size)) encoding.fail("an array claims more bytes than the file has");
    numbers.bytes = source.take(size);
  }
  if (numbers.bytes.size() % array.type.size != 0) encoding.fail("an array ends within a number");
  return numbers;
}

}  // namespace articular::sim
