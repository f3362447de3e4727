#pragma once

// Part of the kernels at eight points: a matrix of each in registers.

#include "fem/simd/element_batch.hpp"
#include "fem/simd/lanes.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

/// @param rows  the nine entries, column-major
/// @param first  of the points that a register holds
inline Matrix load_matrix(const Eight* rows, int first) {
  Matrix A;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) A[j][i] = load(rows[3 * j + i].lane + first);
  return A;
}

inline void store_matrix(const Matrix& A, Eight* rows, int first) {
  for (int k = 0; k < 9; ++k) store(A[k / 3][k % 3], rows[k].lane + first);
}

}  // namespace
}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
