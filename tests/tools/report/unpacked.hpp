#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "tools/report/packed_numbers.hpp"

/// What page/unpack.js does.
namespace articular::tools::report_test {

inline std::string unpacked_bytes(const std::string& base64) {
  std::string compressed;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : base64) {
    if (c == '=') break;
    const std::uint32_t digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                                : c >= 'a' && c <= 'z' ? c - 'a' + 26
                                : c >= '0' && c <= '9' ? c - '0' + 52
                                : c == '+'             ? 62
                                                       : 63;
    bits = bits << 6 | digit;
    count += 6;
    if (count >= 8) compressed += static_cast<char>(bits >> (count -= 8) & 0xffU);
  }
  std::string bytes(1 << 22, '\0');
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                       reinterpret_cast<const Bytef*>(compressed.data()), compressed.size()),
            Z_OK);
  bytes.resize(size);
  return bytes;
}

/// Numbers of `size` bytes, of which all low ones come first.
inline std::vector<std::uint64_t> joined_planes(const std::string& planes, std::size_t size) {
  std::vector<std::uint64_t> numbers(planes.size() / size, 0);
  for (std::size_t which = 0; which < size; ++which)
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] |=
          static_cast<std::uint64_t>(static_cast<unsigned char>(planes[which * numbers.size() + i]))
          << (8 * which);
  return numbers;
}

inline std::vector<std::uint32_t> unpacked_integers(const std::string& packed, std::size_t size,
                                                    std::size_t back) {
  std::vector<std::uint32_t> numbers;
  for (const std::uint64_t number : joined_planes(unpacked_bytes(packed), size)) {
    const std::uint32_t before =
        back > 0 && numbers.size() >= back ? numbers[numbers.size() - back] : 0;
    const std::uint64_t mask = size == 2 ? 0xffffU : 0xffffffffU;
    numbers.push_back(static_cast<std::uint32_t>((number + before) & mask));
  }
  return numbers;
}

inline std::vector<double> unpacked_doubles(const std::string& packed) {
  std::vector<double> numbers;
  for (const std::uint64_t bits : joined_planes(unpacked_bytes(packed), 8))
    numbers.push_back(std::bit_cast<double>(bits));
  return numbers;
}

inline std::vector<double> unquantised(const Json& json, std::size_t frame_size) {
  const double low = json["low"], high = json["high"];
  std::vector<double> values;
  for (const std::uint32_t step :
       unpacked_integers(json["packed"].get<std::string>(), 2, frame_size))
    values.push_back(step == 65535 ? NAN : low + step * (high - low) / 65534);
  return values;
}

}  // namespace articular::tools::report_test
