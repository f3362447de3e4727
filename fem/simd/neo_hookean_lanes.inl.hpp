#pragma once

// Part of element_kernels.inl.hpp: laws Ψ = μ/2 (I1 − 3) + U(J), a register of elements at once.

#include "fem/simd/polar_lanes.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

/// See neo_hookean.hpp.
struct StableVolume {
  double lambda, alpha;  // λ shifted
  StableVolume(double mu, double lambda_) : lambda(lambda_), alpha(1 + mu / lambda_) {}

  struct State {
    Lanes dJ;  // J − α
  };
  State at(Lanes J) const { return {J - alpha}; }
  Lanes value(const State& s) const {
    const double dJ_rest = 1 - alpha;
    return 0.5 * lambda * (s.dJ * s.dJ - dJ_rest * dJ_rest);
  }
  Lanes slope(const State& s) const { return lambda * s.dJ; }
  Lanes slope(const State& s, Lanes volume) const { return lambda * volume * s.dJ; }
  double curvature(const State&) const { return lambda; }
};

/// See coupled_neo_hookean.hpp.
struct LogarithmicVolume {
  double mu, lambda;

  struct State {
    Lanes log_J, inverse_J;
  };
  State at(Lanes J) const { return {log(J), 1 / J}; }
  Lanes value(const State& s) const { return (0.5 * lambda * s.log_J - mu) * s.log_J; }
  Lanes slope(const State& s) const { return (lambda * s.log_J - mu) * s.inverse_J; }
  Lanes slope(const State& s, Lanes volume) const { return volume * slope(s); }
  Lanes curvature(const State& s) const { return (lambda * s.inverse_J - slope(s)) * s.inverse_J; }
};

template <class Volumetric>
struct NeoHookeanLanes {
  double mu;  // [Pa]
  Volumetric volumetric;
  NeoHookeanLanes(double mu_, double lambda) : mu(mu_), volumetric{mu_, lambda} {}

  struct State {
    Matrix F, cof;
    typename Volumetric::State J;
  };
  State at(const Matrix& F) const {
    const Matrix cof = cofactor(F);
    return {F, cof, volumetric.at(dot(F[0], cof[0]))};
  }

  Lanes energy_density(const State& state) const {
    return 0.5 * mu * (squared_norm(state.F) - 3) + volumetric.value(state.J);
  }

  Matrix first_piola(const State& state) const {
    return all(mu) * state.F + volumetric.slope(state.J) * state.cof;
  }

  /// With m_a = cof(F) ∂N_a/∂X, and because Σ ∂N_a/∂X_j ∂²J/∂F_j∂F_l ∂N_b/∂X_l is
  /// −[F (∂N_a/∂X × ∂N_b/∂X)]×,
  ///
  ///   K_ab = V (μ ∂N_a/∂X·∂N_b/∂X 1 + U'' m_a m_bᵀ − U' [F (∂N_a/∂X × ∂N_b/∂X)]×).
  void stiffness(const State& state, const Vector (&g)[3], Lanes volume, Matrix (&K)[6]) const {
    const Vector m[3] = {state.cof * g[0], state.cof * g[1], state.cof * g[2]};
    const Lanes of_cross = -volumetric.slope(state.J, volume);
    int k = 0;
    for (int b = 0; b < 3; ++b) {
      const Vector w = (volumetric.curvature(state.J) * volume) * m[b];
      for (int a = b; a < 3; ++a, ++k) {
        K[k] = outer(m[a], w);
        const Lanes diagonal = mu * volume * dot(g[a], g[b]);
        for (int j = 0; j < 3; ++j) K[k][j][j] += diagonal;
        if (a == b) continue;
        const Vector c = of_cross * (state.F * cross(g[a], g[b]));
        K[k][0][1] += c[2];
        K[k][0][2] -= c[1];
        K[k][1][0] -= c[2];
        K[k][1][2] += c[0];
        K[k][2][0] += c[1];
        K[k][2][1] -= c[0];
      }
    }
  }

  /// In the axes of F = U diag(σ) Vᵀ the tangent falls apart [Smith 2018, sec. 4]: a 3x3 matrix of
  /// the stretches, and a twist and a flip in each plane, with eigenvalues μ ± U' σk.
  void projected_stiffness(const State& state, const Vector (&g)[3], Lanes volume,
                           Matrix (&K)[6]) const {
    const Polar p = polar(state.F);
    const Eigen3 e = eigen(p.T);
    const Matrix& U = e.vectors;
    const Matrix V_transposed = transposed(transposed(p.R) * U);
    const Lanes(&sigma)[3] = e.values;
    const Lanes a = volumetric.slope(state.J);
    const auto b = volumetric.curvature(state.J);
    const Vector c = {sigma[1] * sigma[2], sigma[2] * sigma[0], sigma[0] * sigma[1]};
    const Eigen3 stretches =
        eigen({{mu + b * c[0] * c[0], mu + b * c[1] * c[1], mu + b * c[2] * c[2],
                b * c[1] * c[0] + a * sigma[2], b * c[2] * c[0] + a * sigma[1],
                b * c[2] * c[1] + a * sigma[0]}});
    const Lanes zero{};                  // first in max(): what is not a number stays so
    Lanes kept[3], same[3], crossed[3];  // ∂P_ij/∂F_ij and ∂P_ij/∂F_ji in the plane of axis k
    for (int k = 0; k < 3; ++k) {
      kept[k] = max(zero, stretches.values[k]);
      const Lanes flip = max(zero, mu - a * sigma[k]), twist = max(zero, mu + a * sigma[k]);
      same[k] = 0.5 * (flip + twist);
      crossed[k] = 0.5 * (flip - twist);
    }
    const Symmetric A = compose(stretches.vectors, kept);
    const Vector h[3] = {V_transposed * g[0], V_transposed * g[1], V_transposed * g[2]};
    int block = 0;
    for (int node_b = 0; node_b < 3; ++node_b) {
      const Vector h_b = volume * h[node_b];
      for (int node_a = node_b; node_a < 3; ++node_a, ++block) {
        const Vector& h_a = h[node_a];
        Matrix M;
        for (int i = 0; i < 3; ++i) {
          const Vector A_i = row(A, i);
          for (int j = 0; j < 3; ++j) {
            if (i == j) {
              const int k = (i + 1) % 3, l = (i + 2) % 3;
              M[i][i] =
                  A_i[i] * h_a[i] * h_b[i] + same[l] * h_a[k] * h_b[k] + same[k] * h_a[l] * h_b[l];
            } else {
              M[j][i] = A_i[j] * h_a[i] * h_b[j] + crossed[3 - i - j] * h_a[j] * h_b[i];
            }
          }
        }
        K[block] = (U * M) * transposed(U);
      }
    }
  }
};

}  // namespace
}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
