#pragma once

#include "fem/base/types.hpp"

/// Tangents of energies that depend on invariants of the deformation and of one fibre direction,
///
///   ∂²Ψ/∂F² = Σ Ψ_i ∂²I_i + Σ Ψ_ij ∇I_i ∇I_jᵀ,   I = (I1, I2, I4, I5, J).
///
/// A law adds its Ψ_i and Ψ_ij to those of others, so that the matrix is made once for all terms.
namespace articular::fem {

/// Of C = FᵀF and the unit direction a0 of a fibre at rest [Weiss 1996], see fibre_invariants.hpp.
inline constexpr int kI1 = 0;  // tr C
inline constexpr int kI2 = 1;  // |cof F|²
inline constexpr int kI4 = 2;  // a0·C a0
inline constexpr int kI5 = 3;  // a0·C² a0
inline constexpr int kJ = 4;   // det F
inline constexpr int kNumInvariants = 5;

struct Invariants {
  /// @param a0  zero where there is no fibre
  explicit Invariants(const Mat3& F, const Vec3& a0 = Vec3::Zero());

  double operator[](int i) const { return value[i]; }

  Mat3 F, cofactor;
  Vec3 a0, b, w;  // b = F a0, w = Fᵀb
  Eigen::Matrix<double, kNumInvariants, 1> value;
};

/// Ψ_i and the symmetric Ψ_ij.
struct InvariantSlopes {
  Eigen::Matrix<double, kNumInvariants, 1> first = Eigen::Matrix<double, kNumInvariants, 1>::Zero();
  Eigen::Matrix<double, kNumInvariants, kNumInvariants> second =
      Eigen::Matrix<double, kNumInvariants, kNumInvariants>::Zero();

  /// Of a term f(q(I)): f′ q_i and f′ q_ij + f″ q_i q_j.
  /// @param q  the slopes of q
  void add(const InvariantSlopes& q, double slope, double curvature);
};

/// q = I_i^r J^p with its slopes: an invariant without the change of volume.
struct IsochoricInvariant {
  IsochoricInvariant(const Invariants& I, int i, double r, double p);
  double value;
  InvariantSlopes slopes;
};
/// Ī1 = J^(−2/3) I1, Ī2 = J^(−4/3) I2, λ̄ = J^(−1/3) √I4
IsochoricInvariant first_isochoric_invariant(const Invariants& I);
IsochoricInvariant second_isochoric_invariant(const Invariants& I);
IsochoricInvariant isochoric_stretch(const Invariants& I);

Mat9 tangent(const Invariants& I, const InvariantSlopes& energy);

}  // namespace articular::fem
