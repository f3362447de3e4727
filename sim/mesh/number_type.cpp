#include "sim/mesh/number_type.hpp"

#include <cstdint>

namespace articular::sim {

double number_from(const char* bytes, const NumberType& type, std::endian order) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < type.size; ++i)
    bits = bits << 8 |
           static_cast<unsigned char>(bytes[order == std::endian::big ? i : type.size - 1 - i]);
  switch (type.kind) {
    case NumberType::Kind::Real:
      return type.size == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits))
                            : std::bit_cast<double>(bits);
    case NumberType::Kind::Unsigned:
      return static_cast<double>(bits);
    case NumberType::Kind::Signed:
      break;
  }
  switch (type.size) {
    case 1:
      return static_cast<std::int8_t>(bits);
    case 2:
      return static_cast<std::int16_t>(bits);
    case 4:
      return static_cast<std::int32_t>(bits);
    default:
      return static_cast<double>(static_cast<std::int64_t>(bits));
  }
}

}  // namespace articular::sim
