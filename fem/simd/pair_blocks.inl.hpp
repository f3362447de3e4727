#pragma once

// Part of element_kernels.inl.hpp and stencil_kernels.inl.hpp: 3x3 blocks of pairs of nodes, summed
// over a chunk of the mesh before they go to a matrix.

#include <cstddef>

#include "fem/simd/element_batch.hpp"
#include "fem/simd/lanes.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

inline void set_zero(int num_pairs, const PairSums& sums) {
  for (int p = 0; p < num_pairs; ++p) {
    for (int k = 0; k < 8; k += kWidth) store(Lanes{}, sums.entries[p].lane + k);
    sums.last[p] = 0;
  }
}

/// Adds one block of each element to that of its pair.
template <class Index>
inline void add_block(const Matrix& K_ab, const Index* pair, int count, const PairSums& sums) {
  constexpr int kGroups = 8 / kWidth;
  Lanes part[kGroups][kWidth];  // of each element: entries 0 to 7, kWidth at once
  for (int k = 0; k < 8; ++k) part[k / kWidth][k % kWidth] = K_ab[k / 3][k % 3];
  for (int group = 0; group < kGroups; ++group) transpose(part[group]);
  alignas(64) double last[kWidth];
  store(K_ab[2][2], last);
  for (int lane = 0; lane < kWidth; ++lane) {
    if (lane >= count) break;
    double* const entries = sums.entries[pair[lane]].lane;
    for (int group = 0; group < kGroups; ++group) {
      double* const place = entries + group * kWidth;
      store(load(place) + part[group][lane], place);
    }
    sums.last[pair[lane]] += last[lane];
  }
}

/// Entries 0 to 7 of a block += those of a pair, or of its transpose.
inline void add_entries(const double* entries, double* block) {
  for (int k = 0; k < 8; k += kWidth) store(load(block + k) + load(entries + k), block + k);
}
inline void add_transposed_entries(const double* entries, double* block) {
#if defined(__AVX512F__)
  const Lanes a = load(entries);
  store(load(block) + __builtin_shufflevector(a, a, 0, 3, 6, 1, 4, 7, 2, 5), block);
#else
  for (int k = 0; k < 8; ++k) block[k] += entries[3 * (k % 3) + k / 3];
#endif
}

/// The sums go to the matrix K, to both halves.
/// @param slots  of the pairs that K has, diagonal ones first
inline void add_to_matrix(const PairSums& sums, const PairSlots* slots, int num_diagonal,
                          int num_coupled, double* K) {
  constexpr int kAhead = 12;  // pairs, of two or three lines each
  const auto fetch = [K](int slot) {
    const double* const block = K + std::ptrdiff_t{9} * slot;
    __builtin_prefetch(block, 1);
    __builtin_prefetch(block + 8, 1);
  };
  for (int p = 0; p < num_coupled; ++p) {
    if (p + kAhead < num_coupled) {
      fetch(slots[p + kAhead].lower);
      fetch(slots[p + kAhead].upper);
    }
    double* const lower = K + std::ptrdiff_t{9} * slots[p].lower;
    add_entries(sums.entries[p].lane, lower);
    lower[8] += sums.last[p];
    if (p < num_diagonal) continue;
    double* const upper = K + std::ptrdiff_t{9} * slots[p].upper;
    add_transposed_entries(sums.entries[p].lane, upper);
    upper[8] += sums.last[p];
  }
}

}  // namespace
}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
