#pragma once

#include <immintrin.h>

#include <cstdint>

#include "collision/blocks/simd_box4.hpp"

/// Eight floats of AVX2. A mask has a bit for each lane.
namespace {

struct Vec {
  static constexpr int kWidth = 8;
  __m256 v;
  static Vec load(const float* p) { return {_mm256_load_ps(p)}; }
  static Vec all(float value) { return {_mm256_set1_ps(value)}; }
  void store(float* p) const { _mm256_storeu_ps(p, v); }
};

inline Vec operator+(Vec a, Vec b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Vec operator-(Vec a, Vec b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Vec operator*(Vec a, Vec b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Vec operator/(Vec a, Vec b) { return {_mm256_div_ps(a.v, b.v)}; }
inline Vec min(Vec a, Vec b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Vec max(Vec a, Vec b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Vec sqrt(Vec a) { return {_mm256_sqrt_ps(a.v)}; }
inline unsigned less(Vec a, Vec b) {
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)));
}
inline unsigned less_equal(Vec a, Vec b) {
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}
/// Lanes of eight integers that equal one value.
inline unsigned equal(const int* p, int value) {
  const __m256i same = _mm256_cmpeq_epi32(_mm256_load_si256(reinterpret_cast<const __m256i*>(p)),
                                          _mm256_set1_epi32(value));
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(same)));
}

/// Stores the lanes of the mask one behind the other. Room for all lanes must be there.
inline void store_packed(Vec a, unsigned mask, float* p) {
  float lanes[Vec::kWidth];
  a.store(lanes);
  for (; mask != 0; mask &= mask - 1) *p++ = lanes[__builtin_ctz(mask)];
}

/// Picks lanes out of rows of sixteen, by the low or the high four bits of bytes.
struct Pick {
  __m256i lane;
  static __m256i bytes(const std::uint8_t* lanes) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(lanes)));
  }
  static Pick low_bits(const std::uint8_t* lanes) {
    return {_mm256_and_si256(bytes(lanes), _mm256_set1_epi32(15))};
  }
  static Pick high_bits(const std::uint8_t* lanes) { return {_mm256_srli_epi32(bytes(lanes), 4)}; }
  Vec operator()(const float* row) const {
    const __m256 low = _mm256_permutevar8x32_ps(_mm256_load_ps(row), lane);
    const __m256 high = _mm256_permutevar8x32_ps(_mm256_load_ps(row + 8), lane);
    const __m256 is_high = _mm256_castsi256_ps(_mm256_slli_epi32(lane, 28));  // bit 3 as the sign
    return {_mm256_blendv_ps(low, high, is_high)};
  }
};

/// table[places[i]] in lane i; the table has up to 64 numbers, of which num are used.
inline Vec look_up(const std::uint8_t* places, const float* table, int) {
  return {_mm256_i32gather_ps(table, Pick::bytes(places), 4)};
}

}  // namespace
