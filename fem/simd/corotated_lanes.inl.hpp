#pragma once

// Part of element_kernels.inl.hpp: Corotated (see corotated.hpp), a register of elements at once.

#include "fem/simd/polar_lanes.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

struct CorotatedLanes {
  double mu, lambda;  // [Pa]

  struct State {
    Matrix F;
    Polar polar;
  };
  static State at(const Matrix& F) { return {F, polar(F)}; }

  Lanes energy_density(const State& state) const {
    const Lanes strain = state.polar.trace - 3;
    return mu * squared_norm(state.F - state.polar.R) + 0.5 * lambda * strain * strain;
  }

  Matrix first_piola(const State& state) const {
    const Matrix& R = state.polar.R;
    return all(2 * mu) * (state.F - R) + lambda * (state.polar.trace - 3) * R;
  }

  /// λ tr(RᵀF − I) − 2μ, the factor of ∂R/∂F
  Lanes of_rotation(const State& state) const { return lambda * (state.polar.trace - 3) - 2 * mu; }
  Symmetric twist(const State& state) const {
    Symmetric H = state.polar.G;
    const Lanes factor = of_rotation(state);
    for (Lanes& entry : H.v) entry *= factor;
    return H;
  }
  /// The eigenvalues of the twists, 2μ + 2 of_rotation/(σi + σj), are kept from below 0.
  Symmetric projected_twist(const State& state) const {
    const Eigen3 e = eigen(state.polar.T);
    const Lanes factor = of_rotation(state);
    Lanes values[3];
    for (int k = 0; k < 3; ++k) {
      const Lanes sum = e.values[(k + 1) % 3] + e.values[(k + 2) % 3];
      values[k] = max(factor / max(sum, all(kSmallestSum)), all(-mu));
    }
    return compose(e.vectors, values);
  }

  void stiffness(const State& state, const Vector (&g)[3], Lanes volume, Matrix (&K)[6]) const {
    blocks(state.polar.R, twist(state), g, volume, K);
  }
  void projected_stiffness(const State& state, const Vector (&g)[3], Lanes volume,
                           Matrix (&K)[6]) const {
    blocks(state.polar.R, projected_twist(state), g, volume, K);
  }

 private:
  /// With q_a = R ∂N_a/∂X and δR = [G (q_b × δx_b)]× R, the tangent of corotated.hpp becomes
  ///
  ///   K_ab = V (2μ q_a·q_b 1 + λ q_a q_bᵀ + [q_a]×ᵀ H [q_b]×),   H = of_rotation G.
  void blocks(const Matrix& R, const Symmetric& H, const Vector (&g)[3], Lanes volume,
              Matrix (&K)[6]) const {
    const Vector q[3] = {R * g[0], R * g[1], R * g[2]};
    int k = 0;
    for (int b = 0; b < 3; ++b) {
      const Vector w = volume * q[b], w_lambda = all(lambda) * w;
      const Vector r0 = cross(row(H, 0), w), r1 = cross(row(H, 1), w), r2 = cross(row(H, 2), w);
      for (int a = b; a < 3; ++a, ++k) {
        const Lanes diagonal = 2 * mu * dot(q[a], w);
        for (int j = 0; j < 3; ++j) {
          K[k][j] = cross(Vector{r0[j], r1[j], r2[j]}, q[a]) + w_lambda[j] * q[a];
          K[k][j][j] += diagonal;
        }
      }
    }
  }
};

}  // namespace
}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
