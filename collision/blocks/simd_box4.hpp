#pragma once

#include <immintrin.h>

/// For AVX2 and AVX-512.
namespace {

/// A box of points of four doubles.
struct Box4 {
  __m256d low, high;
  static Box4 at(const double* p) { return {_mm256_loadu_pd(p), _mm256_loadu_pd(p)}; }
  void include(const double* p) {
    const __m256d q = _mm256_loadu_pd(p);
    low = _mm256_min_pd(low, q);
    high = _mm256_max_pd(high, q);
  }
  void store(double* l, double* h) const {
    _mm256_storeu_pd(l, low);
    _mm256_storeu_pd(h, high);
  }
};

}  // namespace
