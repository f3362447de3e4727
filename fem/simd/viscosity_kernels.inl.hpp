#pragma once

// Dashpots at eight points, compiled once for each instruction set by the smoothed_kernels_*.cpp,
// which name it: ARTICULAR_INSTRUCTION_SET.

#include "fem/simd/eight_matrix.inl.hpp"
#include "fem/simd/viscosity_kernels.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

/// S = η (A + Aᵀ) + λ tr(A) 1, A = FᵀḞ
inline Matrix viscous_stress(const EightMotions& motions, const Matrix& F, const Matrix& rate) {
  const Matrix A = transposed(F) * rate;
  Matrix S = all(motions.eta) * (A + transposed(A));
  const Lanes pressure = motions.lambda * (A[0][0] + A[1][1] + A[2][2]);
  for (int k = 0; k < 3; ++k) S[k][k] += pressure;
  return S;
}

void viscous_first_piola(const EightMotions& motions, Eight* P) {
  for (int first = 0; first < kBatchSize; first += kWidth) {
    const Matrix F = load_matrix(motions.F, first);
    const Matrix S = viscous_stress(motions, F, load_matrix(motions.rate, first));
    store_matrix(F * S, P, first);
  }
}

/// With Q = ½ (damping F + stiffness Ḟ) the block of the columns j and l is
/// η (F_l Q_jᵀ + Q_l F_jᵀ) + λ (F_j Q_lᵀ + Q_j F_lᵀ), and for j = l besides η (F Qᵀ + Q Fᵀ);
/// S adds stiffness S_jl 1.
void viscous_tangent(const EightMotions& motions, double damping, double stiffness, Eight* C) {
  const Lanes eta = all(motions.eta), lambda = all(motions.lambda);
  for (int first = 0; first < kBatchSize; first += kWidth) {
    const Matrix F = load_matrix(motions.F, first), rate = load_matrix(motions.rate, first);
    const Matrix Q = all(0.5 * damping) * F + all(0.5 * stiffness) * rate;
    const Matrix S = all(stiffness) * viscous_stress(motions, F, rate);
    const Matrix FQt = F * transposed(Q), on_diagonal = eta * (FQt + transposed(FQt));
    for (int l = 0; l < 3; ++l) {
      for (int j = 0; j < 3; ++j) {
        Matrix B = eta * (outer(F[l], Q[j]) + outer(Q[l], F[j])) +
                   lambda * (outer(F[j], Q[l]) + outer(Q[j], F[l]));
        if (j == l) B = B + on_diagonal;
        for (int k = 0; k < 3; ++k) B[k][k] += S[l][j];
        for (int k = 0; k < 3; ++k)
          for (int i = 0; i < 3; ++i) store(B[k][i], C[(3 * j + i) + 9 * (3 * l + k)].lane + first);
      }
    }
  }
}

}  // namespace

const ViscosityKernels viscosity_kernels{viscous_first_piola, viscous_tangent};

}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
