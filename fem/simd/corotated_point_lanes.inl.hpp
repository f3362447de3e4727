#pragma once

// Part of point_kernels.inl.hpp: Corotated (see corotated.hpp) with a pressure on tr S − 3, a
// register of points at once.

#include "fem/simd/isotropic_lanes.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

struct CorotatedPointLanes {
  double mu, lambda;  // of the distortion [Pa]
  explicit CorotatedPointLanes(const SplitBatchLaw& law) : mu(law.c[0]), lambda(law.c[1]) {}

  struct State {
    Matrix F;
    Polar polar;
    double share;
    Lanes pressure;
  };
  static State at(const Matrix& F, const EightPoints& points, int first) {
    return {F, polar(F), points.share,
            points.pressure == nullptr ? Lanes{} : load(points.pressure->lane + first)};
  }

  Lanes energy_density(const State& s) const {
    const Lanes strain = s.polar.trace - 3;
    return s.share * (mu * squared_norm(s.F - s.polar.R) + 0.5 * lambda * strain * strain) +
           s.pressure * strain;
  }

  Matrix first_piola(const State& s) const {
    const Lanes of_R = s.share * lambda * (s.polar.trace - 3) + s.pressure;
    return all(2 * mu * s.share) * (s.F - s.polar.R) + of_R * s.polar.R;
  }

  void tangent(const State& s, Tangent81& C) const {
    Symmetric H = s.polar.G;
    const Lanes factor = of_rotation(s);
    for (Lanes& entry : H.v) entry *= factor;
    put_together(s, H, C);
  }

  /// The eigenvalues of the twists, share 2μ + 2 of_rotation/(σi + σj), are kept from below 0.
  void projected_tangent(const State& s, Tangent81& C) const {
    const Eigen3 e = eigen(s.polar.T);
    const Lanes factor = of_rotation(s);
    Lanes values[3];
    for (int k = 0; k < 3; ++k) {
      const Lanes sum = e.values[(k + 1) % 3] + e.values[(k + 2) % 3];
      values[k] = max(factor / max(sum, all(kSmallestSum)), all(-s.share * mu));
    }
    put_together(s, compose(e.vectors, values), C);
  }

 private:
  /// The factor of ∂R/∂F
  Lanes of_rotation(const State& s) const {
    return s.share * (lambda * (s.polar.trace - 3) - 2 * mu) + s.pressure;
  }

  /// share (2μ 1 + λ R⊗R) + [R]×ᵀ H [R]×, of the columns of R: see corotated_lanes.inl.hpp.
  void put_together(const State& s, const Symmetric& H, Tangent81& C) const {
    const Matrix& R = s.polar.R;
    for (int l = 0; l < 3; ++l) {
      const Matrix rows{{cross(row(H, 0), R[l]), cross(row(H, 1), R[l]), cross(row(H, 2), R[l])}};
      const Matrix HR = transposed(rows);
      const Vector of_R = all(s.share * lambda) * R[l];
      for (int j = l; j < 3; ++j) {
        Matrix B = outer(R[j], of_R);
        for (int k = 0; k < 3; ++k) {
          B[k] = B[k] + cross(HR[k], R[j]);
          if (j == l) B[k][k] += all(2 * mu * s.share);
        }
        C.block[j + 3 * l] = B;
        if (j != l) C.block[l + 3 * j] = transposed(B);
      }
    }
  }
};

}  // namespace
}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
