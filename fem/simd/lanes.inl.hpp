#pragma once

// Part of element_kernels.inl.hpp: as many doubles as one register holds, and small vectors and
// matrices of them. Everything here has internal linkage and uses no inline function from
// elsewhere: the linker keeps one copy of those for all instruction sets, which may be one that
// the machine does not have.

#include <immintrin.h>

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

#if defined(__AVX512F__)
constexpr int kWidth = 8;
#elif defined(__AVX2__)
constexpr int kWidth = 4;
#else
constexpr int kWidth = 2;
#endif

using Lanes [[gnu::vector_size(8 * kWidth)]] = double;
using Mask [[gnu::vector_size(8 * kWidth)]] = long long;  // of a comparison: all bits or none
using LanesAnywhere [[gnu::vector_size(8 * kWidth), gnu::aligned(8), gnu::may_alias]] = double;

inline Lanes all(double value) { return Lanes{} + value; }
inline Lanes load(const double* p) { return *reinterpret_cast<const LanesAnywhere*>(p); }
inline void store(Lanes a, double* p) { *reinterpret_cast<LanesAnywhere*>(p) = a; }

#if defined(__AVX512F__)
inline Lanes sqrt(Lanes a) { return _mm512_maskz_sqrt_pd(0xff, a); }  // plain: GCC warns
inline unsigned bits(Mask m) {
  const __m512i i = reinterpret_cast<__m512i>(m);
  return _mm512_test_epi64_mask(i, i);
}
#elif defined(__AVX2__)
inline Lanes sqrt(Lanes a) { return _mm256_sqrt_pd(a); }
inline unsigned bits(Mask m) {
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m)));
}
#else
inline Lanes sqrt(Lanes a) { return _mm_sqrt_pd(a); }
inline unsigned bits(Mask m) {
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(m)));
}
#endif

inline Lanes max(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes magnitude(Lanes a) { return a < 0 ? -a : a; }

/// Natural logarithm, lane by lane; not a number below 0.
inline Lanes log(Lanes a) {
  Lanes result{};
  for (int lane = 0; lane < kWidth; ++lane) result[lane] = __builtin_log(a[lane]);
  return result;
}

/// Sum over the lanes, in their order.
inline double sum(Lanes a) {
  double result = 0;
  for (int lane = 0; lane < kWidth; ++lane) result += a[lane];
  return result;
}

/// Turns kWidth rows into kWidth columns.
inline void transpose(Lanes (&v)[kWidth]) {
#if defined(__AVX512F__)
  Lanes pairs[8], fours[8];
  for (int i = 0; i < 8; i += 2) {
    pairs[i] = __builtin_shufflevector(v[i], v[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pairs[i + 1] = __builtin_shufflevector(v[i], v[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int i = 0; i < 8; i += 4) {
    for (int k = 0; k < 2; ++k) {
      const Lanes a = pairs[i + k], b = pairs[i + k + 2];
      fours[i + k] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
      fours[i + k + 2] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (int k = 0; k < 4; ++k) {
    v[k] = __builtin_shufflevector(fours[k], fours[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    v[k + 4] = __builtin_shufflevector(fours[k], fours[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
#elif defined(__AVX2__)
  const Lanes a = __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6),
              b = __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7),
              c = __builtin_shufflevector(v[2], v[3], 0, 4, 2, 6),
              d = __builtin_shufflevector(v[2], v[3], 1, 5, 3, 7);
  v[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  v[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  v[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  v[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
#else
  const Lanes first = __builtin_shufflevector(v[0], v[1], 0, 2);
  v[1] = __builtin_shufflevector(v[0], v[1], 1, 3);
  v[0] = first;
#endif
}

struct Vector {
  Lanes v[3];
  Lanes& operator[](int i) { return v[i]; }
  const Lanes& operator[](int i) const { return v[i]; }
};
inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector operator-(const Vector& a) { return {-a[0], -a[1], -a[2]}; }
inline Vector operator*(Lanes s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Lanes dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Matrix {
  Vector column[3];
  Vector& operator[](int j) { return column[j]; }
  const Vector& operator[](int j) const { return column[j]; }
};
inline Matrix operator+(const Matrix& A, const Matrix& B) {
  return {A[0] + B[0], A[1] + B[1], A[2] + B[2]};
}
inline Matrix operator-(const Matrix& A, const Matrix& B) {
  return {A[0] - B[0], A[1] - B[1], A[2] - B[2]};
}
inline Matrix operator-(const Matrix& A) { return {-A[0], -A[1], -A[2]}; }
inline Matrix operator*(Lanes s, const Matrix& A) { return {s * A[0], s * A[1], s * A[2]}; }
inline Vector operator*(const Matrix& A, const Vector& v) {
  return v[0] * A[0] + v[1] * A[1] + v[2] * A[2];
}
inline Matrix operator*(const Matrix& A, const Matrix& B) { return {A * B[0], A * B[1], A * B[2]}; }
inline Matrix transposed(const Matrix& A) {
  return {{{A[0][0], A[1][0], A[2][0]}, {A[0][1], A[1][1], A[2][1]}, {A[0][2], A[1][2], A[2][2]}}};
}
/// a bᵀ
inline Matrix outer(const Vector& a, const Vector& b) { return {b[0] * a, b[1] * a, b[2] * a}; }
inline Lanes squared_norm(const Matrix& A) {
  return dot(A[0], A[0]) + dot(A[1], A[1]) + dot(A[2], A[2]);
}
/// ∂det(F)/∂F, see cofactor.hpp.
inline Matrix cofactor(const Matrix& F) {
  return {cross(F[1], F[2]), cross(F[2], F[0]), cross(F[0], F[1])};
}

/// A symmetric matrix: 00 11 22 10 20 21.
struct Symmetric {
  Lanes v[6];
};
inline Vector row(const Symmetric& A, int i) {
  return i == 0   ? Vector{A.v[0], A.v[3], A.v[4]}
         : i == 1 ? Vector{A.v[3], A.v[1], A.v[5]}
                  : Vector{A.v[4], A.v[5], A.v[2]};
}
inline Vector operator*(const Symmetric& A, const Vector& v) {
  return {dot(row(A, 0), v), dot(row(A, 1), v), dot(row(A, 2), v)};
}
/// A⁻¹; not finite where A is singular.
inline Symmetric inverse(const Symmetric& A) {
  const Lanes a = A.v[0], b = A.v[1], c = A.v[2], p = A.v[3], q = A.v[4], r = A.v[5];
  const Lanes C00 = b * c - r * r, C10 = q * r - p * c, C20 = p * r - b * q;
  const Lanes s = 1 / (a * C00 + p * C10 + q * C20);
  return {
      {s * C00, s * (a * c - q * q), s * (a * b - p * p), s * C10, s * C20, s * (p * q - a * r)}};
}

}  // namespace
}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
