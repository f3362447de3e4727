#pragma once

// Part of element_kernels.inl.hpp and stencil_kernels.inl.hpp.

#include <cstddef>

#include "fem/simd/lanes.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

/// The vectors of some nodes, 3 a node.
inline Vector gather(const double* x, const int* node) {
  const auto component = [&](int i) {
    const auto at = [&](int lane) { return x[3 * static_cast<std::ptrdiff_t>(node[lane]) + i]; };
#if defined(__AVX512F__)
    return Lanes{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
#elif defined(__AVX2__)
    return Lanes{at(0), at(1), at(2), at(3)};
#else
    return Lanes{at(0), at(1)};
#endif
  };
  return {component(0), component(1), component(2)};
}

}  // namespace
}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
