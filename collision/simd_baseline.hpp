#pragma once

#include <emmintrin.h>

#include <cstdint>

/// Four floats of SSE2, which every x86-64 processor has. A mask has a bit for each lane.
namespace {

struct Vec {
  static constexpr int kWidth = 4;
  __m128 v;
  static Vec load(const float* p) { return {_mm_load_ps(p)}; }
  static Vec all(float value) { return {_mm_set1_ps(value)}; }
  void store(float* p) const { _mm_storeu_ps(p, v); }
};

inline Vec operator+(Vec a, Vec b) { return {_mm_add_ps(a.v, b.v)}; }
inline Vec operator-(Vec a, Vec b) { return {_mm_sub_ps(a.v, b.v)}; }
inline Vec operator*(Vec a, Vec b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Vec operator/(Vec a, Vec b) { return {_mm_div_ps(a.v, b.v)}; }
inline Vec min(Vec a, Vec b) { return {_mm_min_ps(a.v, b.v)}; }
inline Vec max(Vec a, Vec b) { return {_mm_max_ps(a.v, b.v)}; }
inline Vec sqrt(Vec a) { return {_mm_sqrt_ps(a.v)}; }
inline unsigned less(Vec a, Vec b) {
  return static_cast<unsigned>(_mm_movemask_ps(_mm_cmplt_ps(a.v, b.v)));
}
inline unsigned less_equal(Vec a, Vec b) {
  return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a.v, b.v)));
}
/// Lanes of four integers that equal one value.
inline unsigned equal(const int* p, int value) {
  const __m128i same =
      _mm_cmpeq_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(p)), _mm_set1_epi32(value));
  return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(same)));
}

/// Stores the lanes of the mask one behind the other. Room for all lanes must be there.
inline void store_packed(Vec a, unsigned mask, float* p) {
  float lanes[Vec::kWidth];
  a.store(lanes);
  for (; mask != 0; mask &= mask - 1) *p++ = lanes[__builtin_ctz(mask)];
}

/// Picks lanes out of rows of sixteen.
struct Pick {
  std::uint8_t lane[Vec::kWidth];
  static Pick load(const std::uint8_t* lanes) {
    Pick pick;
    for (int i = 0; i < Vec::kWidth; ++i) pick.lane[i] = lanes[i];
    return pick;
  }
  Vec operator()(const float* row) const {
    return {_mm_setr_ps(row[lane[0]], row[lane[1]], row[lane[2]], row[lane[3]])};
  }
};

}  // namespace
