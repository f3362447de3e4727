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

/// Picks lanes out of rows of sixteen, by the low or the high four bits of bytes.
struct Pick {
  std::uint8_t lane[Vec::kWidth];
  static Pick low_bits(const std::uint8_t* lanes) {
    Pick pick;
    for (int i = 0; i < Vec::kWidth; ++i) pick.lane[i] = lanes[i] & 15;
    return pick;
  }
  static Pick high_bits(const std::uint8_t* lanes) {
    Pick pick;
    for (int i = 0; i < Vec::kWidth; ++i) pick.lane[i] = static_cast<std::uint8_t>(lanes[i] >> 4);
    return pick;
  }
  Vec operator()(const float* row) const {
    return {_mm_setr_ps(row[lane[0]], row[lane[1]], row[lane[2]], row[lane[3]])};
  }
};

/// table[places[i]] in lane i; the table has up to 64 numbers, of which num are used.
inline Vec look_up(const std::uint8_t* places, const float* table, int) {
  return {_mm_setr_ps(table[places[0]], table[places[1]], table[places[2]], table[places[3]])};
}

/// A box of points of four doubles.
struct Box4 {
  __m128d low[2], high[2];
  static Box4 at(const double* p) {
    const __m128d xy = _mm_loadu_pd(p), zw = _mm_loadu_pd(p + 2);
    return {{xy, zw}, {xy, zw}};
  }
  void include(const double* p) {
    for (int half = 0; half < 2; ++half) {
      const __m128d q = _mm_loadu_pd(p + 2 * half);
      low[half] = _mm_min_pd(low[half], q);
      high[half] = _mm_max_pd(high[half], q);
    }
  }
  void store(double* l, double* h) const {
    for (int half = 0; half < 2; ++half) {
      _mm_storeu_pd(l + 2 * half, low[half]);
      _mm_storeu_pd(h + 2 * half, high[half]);
    }
  }
};

}  // namespace
