#pragma once

// Part of element_kernels.inl.hpp: polar rotations and eigenvectors, a register of matrices at
// once.

#include "fem/simd/element_kernels.hpp"
#include "fem/simd/lanes.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

/// Σ i + Σ j of signed singular values counts as this where it is smaller [-], as in Corotated.
constexpr double kSmallestSum = 1e-6;

struct Polar {
  Matrix R;     // the rotation nearest to F, det R = +1 where F is inverted, too
  Symmetric T;  // F Rᵀ = U diag(σ) Uᵀ, with the sign of det F at the smallest σ
  Lanes trace;  // of T
  Symmetric G;  // (tr(T) 1 − T)⁻¹ = U diag(1/(σi + σj)) Uᵀ: turns moments into rotations
};

/// Lanes of the mask by singular value decomposition. Not inlined: what takes single lanes apart
/// lives in memory, and would keep the ordinary path out of the registers.
[[gnu::noinline]] void repair(const Matrix& F, unsigned lanes, Polar& polar) {
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = __builtin_ctz(lanes);
    double F_lane[9], U[9], V[9], sigma[3];
    for (int k = 0; k < 9; ++k) F_lane[k] = F[k / 3][k % 3][lane];
    svd_of_hard_case(F_lane, U, V, sigma);
    double trace = 0, inverse_sum[3];
    for (int k = 0; k < 3; ++k) {
      trace += sigma[k];
      const double sum = sigma[(k + 1) % 3] + sigma[(k + 2) % 3];
      inverse_sum[k] = 1 / (sum > kSmallestSum ? sum : kSmallestSum);
    }
    const auto entry = [](const double* A, const double* d, const double* B, int i, int j) {
      return A[i] * d[0] * B[j] + A[i + 3] * d[1] * B[j + 3] + A[i + 6] * d[2] * B[j + 6];
    };
    const double ones[3] = {1, 1, 1};
    for (int k = 0; k < 9; ++k) polar.R[k / 3][k % 3][lane] = entry(U, ones, V, k % 3, k / 3);
    constexpr int kRow[6] = {0, 1, 2, 1, 2, 2}, kColumn[6] = {0, 1, 2, 0, 0, 1};
    for (int k = 0; k < 6; ++k) {
      polar.T.v[k][lane] = entry(U, sigma, U, kRow[k], kColumn[k]);
      polar.G.v[k][lane] = entry(U, inverse_sum, U, kRow[k], kColumn[k]);
    }
    polar.trace[lane] = trace;
  }
}

inline Symmetric symmetric_part(const Matrix& A) {
  return {{A[0][0], A[1][1], A[2][2], 0.5 * (A[0][1] + A[1][0]), 0.5 * (A[0][2] + A[2][0]),
           0.5 * (A[1][2] + A[2][1])}};
}

/// (tr(T) 1 − T)⁻¹
inline Symmetric inverse_of_sums(const Symmetric& T) {
  return inverse({{T.v[1] + T.v[2], T.v[2] + T.v[0], T.v[0] + T.v[1], -T.v[3], -T.v[4], -T.v[5]}});
}

/// One step towards RᵀR = 1 and one towards a symmetric F Rᵀ, both quadratic.
/// @return how far the steps went, not a number where R is none
inline Lanes correct(const Matrix& F, Matrix& R) {
  // R ← R − R (RᵀR − 1)/2
  const Lanes d00 = 0.5 * dot(R[0], R[0]) - 0.5, d11 = 0.5 * dot(R[1], R[1]) - 0.5,
              d22 = 0.5 * dot(R[2], R[2]) - 0.5, d10 = 0.5 * dot(R[1], R[0]),
              d20 = 0.5 * dot(R[2], R[0]), d21 = 0.5 * dot(R[2], R[1]);
  R = R - R * Matrix{{{d00, d10, d20}, {d10, d11, d21}, {d20, d21, d22}}};
  // R ← (1 + [ω]×) R with ω = G axl(T − Tᵀ)
  const Matrix T = F * transposed(R);
  const Vector omega = inverse_of_sums(symmetric_part(T)) *
                       Vector{T[1][2] - T[2][1], T[2][0] - T[0][2], T[0][1] - T[1][0]};
  R = R + Matrix{{cross(omega, R[0]), cross(omega, R[1]), cross(omega, R[2])}};
  return sqrt(d00 * d00 + d11 * d11 + d22 * d22 + d10 * d10 + d20 * d20 + d21 * d21 +
              dot(omega, omega));
}

/// The polar rotation without iterating on matrices. With S = RᵀF, s = tr S, C = FᵀF = S²,
/// p = (s² − tr C)/2 and d = det F, Cayley-Hamilton turns F = R S into
///
///   R = (½ (s² + tr C) F + s cof F − F C) / (s p − d),   s p − d = (σ0+σ1)(σ1+σ2)(σ2+σ0),
///
/// and s is the largest root of that quartic whose four roots are real [Horn 1987, sec. 4]:
///
///   s⁴ − 2 |F|² s² − 8 d s + |F|⁴ − 4 |cof F|² = 0.
///
/// Newton's method falls to it monotonically from √3 |F| ≥ s. Where the denominator is small
/// (σ1 + σ2 < σ0/3 or so), R is corrected; where it is very small, or something does not converge,
/// the singular value decomposition has the lane.
///
/// [Horn 1987] Horn. Closed-form Solution of Absolute Orientation Using Unit Quaternions.
///             J. Opt. Soc. Am. A 4(4).
inline Polar polar(const Matrix& F) {
  constexpr int kMaxSteps = 12;       // of Newton's method; three to five do
  constexpr double kLastStep = 1e-8;  // relative to s: the next one would be round-off
  // Denominators relative to s³, 8/27 at rest. R loses a digit for each factor of three or so.
  constexpr double kGoodDenominator = 0.15, kSmallestDenominator = 2e-3;
  constexpr double kSmallestTrace = 0.02;      // smaller ones come near kSmallestSum
  constexpr double kLargestCorrection = 1e-7;  // its square is round-off

  const Matrix cof = cofactor(F);
  const Lanes d = dot(F[0], cof[0]), norm2 = squared_norm(F);
  const Lanes c2 = -2 * norm2, c1 = -8 * d, c0 = norm2 * norm2 - 4 * squared_norm(cof);
  Lanes s = sqrt(3 * norm2);
  Mask open = {};
  for (int step = 0; step < kMaxSteps; ++step) {
    const Lanes s2 = s * s;
    const Lanes change = (((s2 + c2) * s + c1) * s + c0) / ((4 * s2 + 2 * c2) * s + c1);
    s -= change;
    open = ~(magnitude(change) <= kLastStep * s);  // not a number included
    if (bits(open) == 0) break;
  }
  const Lanes denominator = 0.5 * s * (s * s - norm2) - d, s3 = s * s * s;
  const Lanes inverse_denominator = 1 / denominator;
  const Lanes of_F = 0.5 * (s * s + norm2) * inverse_denominator, of_cof = s * inverse_denominator;
  const Matrix Ft = transposed(F);
  const Matrix FC = F * (inverse_denominator * Matrix{{Ft * F[0], Ft * F[1], Ft * F[2]}});
  Matrix R = of_F * F + of_cof * cof - FC;

  unsigned hard = bits(open | ~(s >= kSmallestTrace));
  if (bits(~(denominator >= kGoodDenominator * s3)) != 0) [[unlikely]] {
    hard |=
        bits(~(correct(F, R) <= kLargestCorrection) | ~(denominator >= kSmallestDenominator * s3));
  }
  const Matrix T = F * transposed(R);
  Polar result;
  result.R = R;
  result.T = symmetric_part(T);
  result.trace = T[0][0] + T[1][1] + T[2][2];
  result.G = inverse_of_sums(result.T);
  if (hard != 0) [[unlikely]] {
    Polar repaired = result;
    repair(F, hard, repaired);
    result = repaired;
  }
  return result;
}

struct Eigen3 {
  Matrix vectors;  // a rotation
  Lanes values[3];
};

/// Cyclic Jacobi rotations [Golub 2013, sec. 8.5]: T = vectors diag(values) vectorsᵀ.
///
/// [Golub 2013] Golub, Van Loan. Matrix Computations, 4th ed. Johns Hopkins.
inline Eigen3 eigen(const Symmetric& T) {
  constexpr int kMaxSweeps = 8;        // the last one squares what is left: four or five do
  constexpr double kDiagonal = 1e-16;  // entries beside the diagonal, relative to the norm
  constexpr double kTiny = 1e-300;     // no division by 0 where all is diagonal
  const Lanes one = all(1), zero = all(0);
  Eigen3 e{{{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}}, {T.v[0], T.v[1], T.v[2]}};
  Lanes beside[3] = {T.v[5], T.v[4], T.v[3]};  // entry k couples the other two axes
  const Lanes norm2 = T.v[0] * T.v[0] + T.v[1] * T.v[1] + T.v[2] * T.v[2] +
                      2 * (T.v[3] * T.v[3] + T.v[4] * T.v[4] + T.v[5] * T.v[5]);
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    const Lanes left = beside[0] * beside[0] + beside[1] * beside[1] + beside[2] * beside[2];
    if (bits(left > kDiagonal * kDiagonal * norm2) == 0) break;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const Lanes half = 0.5 * (e.values[j] - e.values[i]), b = beside[k];
      const Lanes size = magnitude(half) + sqrt(half * half + b * b);
      const Lanes t = (half < 0 ? -b : b) / max(size, all(kTiny));
      const Lanes c = 1 / sqrt(1 + t * t), s = c * t;
      e.values[i] -= t * b;
      e.values[j] += t * b;
      beside[k] = zero;
      const Lanes b_i = beside[i], b_j = beside[j];  // (j, k) and (i, k)
      beside[j] = c * b_j - s * b_i;
      beside[i] = s * b_j + c * b_i;
      const Vector v_i = e.vectors[i], v_j = e.vectors[j];
      e.vectors[i] = c * v_i - s * v_j;
      e.vectors[j] = s * v_i + c * v_j;
    }
  }
  return e;
}

/// vectors diag(values) vectorsᵀ
inline Symmetric compose(const Matrix& Q, const Lanes (&d)[3]) {
  const Vector a = d[0] * Q[0], b = d[1] * Q[1], c = d[2] * Q[2];
  const auto entry = [&](int i, int j) { return a[i] * Q[0][j] + b[i] * Q[1][j] + c[i] * Q[2][j]; };
  return {{entry(0, 0), entry(1, 1), entry(2, 2), entry(1, 0), entry(2, 0), entry(2, 1)}};
}

}  // namespace
}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
