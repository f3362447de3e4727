#pragma once

#include <immintrin.h>

#include <cstdint>

#include "collision/blocks/simd_box4.hpp"

/// Sixteen floats of AVX-512 F. A mask has a bit for each lane.
namespace {

// The forms without a mask set off a false warning of g++ 12 (GCC bug 105593).
constexpr __mmask16 kAll = 0xffff;

struct Vec {
  static constexpr int kWidth = 16;
  __m512 v;
  static Vec load(const float* p) { return {_mm512_load_ps(p)}; }
  static Vec all(float value) { return {_mm512_set1_ps(value)}; }
  void store(float* p) const { _mm512_storeu_ps(p, v); }
};

inline Vec operator+(Vec a, Vec b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Vec operator-(Vec a, Vec b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Vec operator*(Vec a, Vec b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Vec operator/(Vec a, Vec b) { return {_mm512_div_ps(a.v, b.v)}; }
inline Vec min(Vec a, Vec b) { return {_mm512_maskz_min_ps(kAll, a.v, b.v)}; }
inline Vec max(Vec a, Vec b) { return {_mm512_maskz_max_ps(kAll, a.v, b.v)}; }
inline Vec sqrt(Vec a) { return {_mm512_maskz_sqrt_ps(kAll, a.v)}; }
inline unsigned less(Vec a, Vec b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ); }
inline unsigned less_equal(Vec a, Vec b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ); }
/// Lanes of sixteen integers that equal one value.
inline unsigned equal(const int* p, int value) {
  return _mm512_cmpeq_epi32_mask(_mm512_load_si512(p), _mm512_set1_epi32(value));
}

/// Stores the lanes of the mask one behind the other. Room for all lanes must be there.
inline void store_packed(Vec a, unsigned mask, float* p) {
  _mm512_storeu_ps(p, _mm512_maskz_compress_ps(static_cast<__mmask16>(mask), a.v));
}

/// Picks lanes out of rows of sixteen, by the low or the high four bits of bytes.
struct Pick {
  __m512i lane;
  static __m512i bytes(const std::uint8_t* lanes) {
    return _mm512_maskz_cvtepu8_epi32(kAll,
                                      _mm_loadu_si128(reinterpret_cast<const __m128i*>(lanes)));
  }
  // The permutation looks at the low four bits only.
  static Pick low_bits(const std::uint8_t* lanes) { return {bytes(lanes)}; }
  static Pick high_bits(const std::uint8_t* lanes) {
    return {_mm512_maskz_srli_epi32(kAll, bytes(lanes), 4)};
  }
  Vec operator()(const float* row) const {
    return {_mm512_maskz_permutexvar_ps(kAll, lane, _mm512_load_ps(row))};
  }
};

/// table[places[i]] in lane i; the table has up to 64 numbers, of which num are used.
inline Vec look_up(const std::uint8_t* places, const float* table, int num) {
  const __m512i lanes = Pick::bytes(places);
  if (num > 32) return {_mm512_mask_i32gather_ps(_mm512_setzero_ps(), kAll, lanes, table, 4)};
  return {_mm512_permutex2var_ps(_mm512_load_ps(table), lanes, _mm512_load_ps(table + 16))};
}

}  // namespace
