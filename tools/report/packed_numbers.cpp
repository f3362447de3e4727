#include "tools/report/packed_numbers.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <new>

namespace articular::tools {
namespace {

constexpr std::uint32_t kSteps = 65534, kNoNumber = 65535;

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                Z_BEST_COMPRESSION) != Z_OK)
    throw std::bad_alloc();  // it fails for nothing else where there is this much room
  result.resize(size);
  return result;
}

char byte_of(std::uint64_t number, int which) {
  return static_cast<char>(static_cast<unsigned char>(number >> (8 * which)));
}

}  // namespace

double largest_size(const std::vector<double>& numbers) {
  double largest = 0;
  for (const double number : numbers)
    if (std::isfinite(number)) largest = std::max(largest, std::abs(number));
  return largest;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kDigits[three >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::string packed_integers(const std::vector<std::uint32_t>& numbers, int bytes,
                            std::size_t back) {
  std::string planes;
  planes.reserve(numbers.size() * static_cast<std::size_t>(bytes));
  for (int which = 0; which < bytes; ++which)
    for (std::size_t i = 0; i < numbers.size(); ++i)
      planes += byte_of(back > 0 && i >= back ? numbers[i] - numbers[i - back] : numbers[i], which);
  return base64(compressed(planes));
}

std::string packed_doubles(const std::vector<double>& numbers) {
  std::string planes;
  planes.reserve(numbers.size() * sizeof(double));
  for (int which = 0; which < static_cast<int>(sizeof(double)); ++which)
    for (const double number : numbers)
      planes += byte_of(std::bit_cast<std::uint64_t>(number), which);
  return base64(compressed(planes));
}

Json quantised(const std::vector<double>& numbers, std::size_t frame_size) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double number : numbers)
    if (std::isfinite(number)) {
      low = std::min(low, number);
      high = std::max(high, number);
    }
  if (low > high) low = high = 0;  // nothing is finite
  const double step = (high - low) / kSteps;
  std::vector<std::uint32_t> steps;
  steps.reserve(numbers.size());
  for (const double number : numbers)
    steps.push_back(!std::isfinite(number) ? kNoNumber
                    : step > 0 ? static_cast<std::uint32_t>(std::lround((number - low) / step))
                               : 0U);
  return {{"low", low}, {"high", high}, {"packed", packed_integers(steps, 2, frame_size)}};
}

}  // namespace articular::tools
