#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

namespace articular::fem {

/// Four numbers that the processor adds and multiplies at once.
using Float4 [[gnu::vector_size(16)]] = float;

inline Float4 load4(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store4(float* p, Float4 v) { std::memcpy(p, &v, sizeof v); }
/// (a₂ a₃ b₀ b₁)
inline Float4 middle(Float4 a, Float4 b) { return __builtin_shufflevector(a, b, 2, 3, 4, 5); }
/// (p p q q)
inline Float4 pair_of(float p, float q) { return Float4{p, p, q, q}; }

/// Loads and stores take four numbers where a block or a vector ends with three or two: arrays have
/// this many more entries than they need.
inline constexpr std::size_t kPadding = 4;

inline std::vector<float> padded(std::size_t size) {
  return std::vector<float>(size + kPadding, 0.0F);
}

/// The blocks beside the diagonal of a symmetric matrix of N x N blocks whose diagonal blocks are
/// the identity, both halves, in compressed rows. Blocks are column-major.
template <int N>
struct BlockRows {
  static constexpr int kSize = N;
  std::vector<int> row_begin{0}, column;  // columns sorted within a row
  std::vector<float> values;              // N² a block, padded

  int num_rows() const { return static_cast<int>(row_begin.size()) - 1; }
  const float* block(int slot) const { return values.data() + std::ptrdiff_t{N} * N * slot; }
  float* block(int slot) { return values.data() + std::ptrdiff_t{N} * N * slot; }
};

/// Row i of the product with x, without the diagonal: sum[0 .. N), with room for 8.
inline void row_product(const BlockRows<3>& A, int i, const float* x, float* sum) {
  Float4 s0{}, s1{}, s2{};  // the fourth entries are of no meaning
  const float* a = A.block(A.row_begin[i]);
  for (int k = A.row_begin[i]; k < A.row_begin[i + 1]; ++k, a += 9) {
    const Float4 x_j = load4(x + std::ptrdiff_t{3} * A.column[k]);  // one load less than by parts
    s0 += load4(a) * __builtin_shufflevector(x_j, x_j, 0, 0, 0, 0);
    s1 += load4(a + 3) * __builtin_shufflevector(x_j, x_j, 1, 1, 1, 1);
    s2 += load4(a + 6) * __builtin_shufflevector(x_j, x_j, 2, 2, 2, 2);
  }
  store4(sum, s0 + s1 + s2);
}

inline void row_product(const BlockRows<6>& A, int i, const float* x, float* sum) {
  // Two columns of six are three times four numbers: (a0..a3) (a4 a5 b0 b1) (b2..b5).
  Float4 s0{}, s1{}, s2{};
  const float* a = A.block(A.row_begin[i]);
  for (int k = A.row_begin[i]; k < A.row_begin[i + 1]; ++k) {
    const float* x_j = x + std::ptrdiff_t{6} * A.column[k];
    for (int c = 0; c < 6; c += 2, a += 12) {
      s0 += load4(a) * x_j[c];
      s1 += load4(a + 4) * pair_of(x_j[c], x_j[c + 1]);
      s2 += load4(a + 8) * x_j[c + 1];
    }
  }
  const Float4 zero{};
  // Rows 0..3: s0 + (s1₂ s1₃ s2₀ s2₁); rows 4, 5: (s1₀ s1₁) + (s2₂ s2₃).
  store4(sum, s0 + middle(s1, s2));
  store4(sum + 4, s1 + middle(s2, zero));
}

}  // namespace articular::fem
