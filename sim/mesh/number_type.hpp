#pragma once

#include <bit>
#include <cstddef>

namespace articular::sim {

/// Kind and size of the numbers in a binary file.
struct NumberType {
  enum class Kind { Signed, Unsigned, Real };

  std::size_t size = 0;  // 1, 2, 4 or 8 [byte]; real ones have 4 or 8
  Kind kind = Kind::Signed;
};

/// The number that `type.size` bytes hold. Whole numbers beyond 2⁵³ are rounded.
double number_from(const char* bytes, const NumberType& type, std::endian order);

}  // namespace articular::sim
