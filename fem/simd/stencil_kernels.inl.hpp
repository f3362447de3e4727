#pragma once

// The loops over eight stencils, compiled once for each instruction set by the
// smoothed_kernels_*.cpp, which name it: ARTICULAR_INSTRUCTION_SET.

#include <cstddef>

#include "fem/base/tangent.hpp"
#include "fem/simd/gather_lanes.inl.hpp"
#include "fem/simd/pair_blocks.inl.hpp"
#include "fem/simd/stencil_kernels.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

inline Vector load_gradient(const StencilBatch& batch, int a, int first) {
  return {load(batch.gradient[3 * a].lane + first), load(batch.gradient[3 * a + 1].lane + first),
          load(batch.gradient[3 * a + 2].lane + first)};
}

/// Of the lanes from `first` on, those that exist.
inline int count_from(const StencilBatch& batch, int first) {
  const int left = batch.count - first;
  return left < kWidth ? left : kWidth;
}

/// Written with edges, so that a translation cancels first.
void deformation_gradient(const StencilBatch& batch, const double* x, Eight* F) {
  for (int first = 0; first < 8; first += kWidth) {
    const Vector x0 = gather(x, batch.node[0].lane + first);
    Matrix sum{};
    for (int a = 1; a < batch.num_nodes; ++a) {
      const Vector edge = gather(x, batch.node[a].lane + first) - x0;
      sum = sum + outer(edge, load_gradient(batch, a, first));
    }
    for (int k = 0; k < 9; ++k) store(sum[k / 3][k % 3], F[k].lane + first);
  }
}

void add_force(const StencilBatch& batch, const Eight* P_of, double* f) {
  for (int first = 0; first < batch.count; first += kWidth) {
    const int count = count_from(batch, first);
    const Lanes volume = load(batch.volume->lane + first);
    Matrix P;
    for (int k = 0; k < 9; ++k) P[k / 3][k % 3] = volume * load(P_of[k].lane + first);
    for (int a = 0; a < batch.num_nodes; ++a) {
      const Vector nodal = P * load_gradient(batch, a, first);
      alignas(64) double value[3][kWidth];
      for (int i = 0; i < 3; ++i) store(nodal[i], value[i]);
      for (int lane = 0; lane < count; ++lane) {
        double* const f_a = f + 3 * static_cast<std::ptrdiff_t>(batch.node[a].lane[first + lane]);
        for (int i = 0; i < 3; ++i) f_a[i] += value[i][lane];
      }
    }
  }
}

void add_stiffness(const StencilBatch& batch, const Eight* C, double scale,
                   const EightIndices* pair, const PairSums& sums) {
  for (int first = 0; first < batch.count; first += kWidth) {
    const int count = count_from(batch, first);
    const Lanes volume = scale * load(batch.volume->lane + first);
    const EightIndices* pair_ab = pair;
    for (int b = 0; b < batch.num_nodes; ++b) {
      const Vector g_b = volume * load_gradient(batch, b, first);
      Matrix CB[3];  // C · g_b: block j
      for (int j = 0; j < 3; ++j) {
        for (int k = 0; k < 3; ++k) {
          for (int i = 0; i < 3; ++i) {
            const Eight* const entry = C + (3 * j + i) + 9 * k;
            CB[j][k][i] = load(entry[0].lane + first) * g_b[0] +
                          load(entry[27].lane + first) * g_b[1] +
                          load(entry[54].lane + first) * g_b[2];
          }
        }
      }
      for (int a = b; a < batch.num_nodes; ++a, ++pair_ab) {
        const Vector g_a = load_gradient(batch, a, first);
        add_block(g_a[0] * CB[0] + g_a[1] * CB[1] + g_a[2] * CB[2], pair_ab->lane + first, count,
                  sums);
      }
    }
  }
}

void add_pressure_gradient(const StencilBatch& batch, const Eight* P_of, const EightIndices* slot,
                           double* G) {
  for (int first = 0; first < batch.count; first += kWidth) {
    const int count = count_from(batch, first);
    const Lanes quarter = 0.25 * load(batch.volume->lane + first);
    Matrix P;
    for (int k = 0; k < 9; ++k) P[k / 3][k % 3] = quarter * load(P_of[k].lane + first);
    for (int a = 0; a < 4; ++a) {
      const Vector nodal = P * load_gradient(batch, a, first);
      alignas(64) double value[3][kWidth];
      for (int i = 0; i < 3; ++i) store(nodal[i], value[i]);
      for (int lane = 0; lane < count; ++lane) {
        for (int c = 0; c < 4; ++c) {
          double* const G_ac =
              G + 3 * static_cast<std::ptrdiff_t>(slot[4 * a + c].lane[first + lane]);
          for (int i = 0; i < 3; ++i) G_ac[i] += value[i][lane];
        }
      }
    }
  }
}

/// By LDLᵀ of C + ε |C| 1, as projected() has it by Cholesky.
unsigned indefinite(const Eight* C) {
  unsigned result = 0;
  for (int first = 0; first < kBatchSize; first += kWidth) {
    const auto entry = [&](int m, int n) { return load(C[m + 9 * n].lane + first); };
    Lanes squared_norm{};
    for (int k = 0; k < 81; ++k) squared_norm += entry(k, 0) * entry(k, 0);
    const Lanes shift = kRoundOffOfProjection * sqrt(squared_norm);
    Lanes L[9][9], d[9];
    Mask fails{};
    for (int j = 0; j < 9; ++j) {
      Lanes scaled[9]{};  // d_k L_jk
      d[j] = entry(j, j) + shift;
      for (int k = 0; k < j; ++k) {
        scaled[k] = d[k] * L[j][k];
        d[j] -= scaled[k] * L[j][k];
      }
      fails |= ~(d[j] > 0);
      const Lanes inverse = 1 / d[j];
      for (int i = j + 1; i < 9; ++i) {
        Lanes sum = entry(i, j);
        for (int k = 0; k < j; ++k) sum -= scaled[k] * L[i][k];
        L[i][j] = inverse * sum;
      }
    }
    result |= bits(fails) << first;
  }
  return result;
}

}  // namespace

const StencilKernels stencil_kernels{deformation_gradient,  add_force,  add_stiffness,
                                     add_pressure_gradient, indefinite, set_zero,
                                     add_to_matrix};

}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
