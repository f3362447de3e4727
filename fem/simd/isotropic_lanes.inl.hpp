#pragma once

// Part of point_kernels.inl.hpp: laws of the invariants I1 = |F|², I2 = |cof F|² and J = det F, a
// register of points at once.

#include "fem/simd/point_kernels.hpp"
#include "fem/simd/polar_lanes.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

struct Invariants {
  Lanes I1, I2, J;
};

/// Derivatives of an energy by the invariants; those left out are zero in all laws here.
struct Slopes {
  Lanes I1{}, I2{}, J{}, I1_I1{}, I1_J{}, I2_J{}, J_J{};
};

/// x^(−1/3) to round-off; not a number where x is not positive.
inline Lanes inverse_cube_root(Lanes x) {
  // The bits of a positive double are nearly linear in its logarithm. As doubles they count in
  // 2^12 units of the last place: 52 bits behind the exponent of 2^52.
  constexpr double kTwo52 = 4503599627370496;
  const Mask exponent_of_two52 = Mask{} + 0x4330000000000000;
  const Lanes logarithm =
      reinterpret_cast<Lanes>((reinterpret_cast<Mask>(x) >> 12) | exponent_of_two52) - kTwo52;
  // 4/3 of the bits of 1 minus a third of those of x: exact for powers of 8, 6 % off at most.
  constexpr double kOne = 1023.0 * 1099511627776.0;  // bits of 1, shifted by 12
  const Lanes guess_bits = (4.0 / 3) * kOne - (1.0 / 3) * logarithm + kTwo52;
  Lanes y = reinterpret_cast<Lanes>(reinterpret_cast<Mask>(guess_bits) << 12);
  // The cubic step y (1 + e/3 + 2 e²/9) with e = 1 − x y³: errors 6e-2, 1e-3, 1e-8, round-off.
  for (int step = 0; step < 3; ++step) {
    const Lanes e = 1 - x * y * y * y;
    y += y * e * (1.0 / 3 + (2.0 / 9) * e);
  }
  return x > 0 ? y : all(__builtin_nan(""));
}

/// See neo_hookean.hpp.
struct NeoHookeanEnergy {
  static constexpr bool kHasI2 = false;
  double mu, lambda, alpha;
  explicit NeoHookeanEnergy(const SplitBatchLaw& law)
      : mu(law.c[0]), lambda(law.c[1]), alpha(1 + mu / lambda) {}

  Lanes value(const Invariants& i) const {
    const Lanes dJ = i.J - alpha;
    return 0.5 * mu * (i.I1 - 3) + 0.5 * lambda * (dJ * dJ - (1 - alpha) * (1 - alpha));
  }
  void add_slopes(const Invariants& i, double share, Slopes& s) const {
    s.I1 += share * 0.5 * mu;
    s.J += share * lambda * (i.J - alpha);
    s.J_J += share * lambda;
  }
};

/// See coupled_neo_hookean.hpp.
struct CoupledNeoHookeanEnergy {
  static constexpr bool kHasI2 = false;
  double mu, lambda;
  explicit CoupledNeoHookeanEnergy(const SplitBatchLaw& law) : mu(law.c[0]), lambda(law.c[1]) {}

  Lanes value(const Invariants& i) const {
    const Lanes log_J = log(i.J);
    return 0.5 * mu * (i.I1 - 3) + (0.5 * lambda * log_J - mu) * log_J;
  }
  void add_slopes(const Invariants& i, double share, Slopes& s) const {
    const Lanes inverse_J = 1 / i.J, slope = (lambda * log(i.J) - mu) * inverse_J;
    s.I1 += share * 0.5 * mu;
    s.J += share * slope;
    s.J_J += share * (lambda * inverse_J - slope) * inverse_J;
  }
};

/// c10 (Ī1 − 3) + c20 (Ī1 − 3)² + c01 (Ī2 − 3), Ī1 = J^(−2/3) I1, Ī2 = J^(−4/3) I2: see
/// mooney_rivlin.hpp and yeoh.hpp.
template <bool kSecondInvariant>
struct PolynomialEnergy {
  static constexpr bool kHasI2 = kSecondInvariant;
  double c10, c20, c01;
  explicit PolynomialEnergy(const SplitBatchLaw& law)
      : c10(law.c[0]), c20(law.c[1]), c01(law.c[2]) {}

  Lanes value(const Invariants& i) const {
    const Lanes root = inverse_cube_root(i.J), a = root * root, strain = a * i.I1 - 3;
    Lanes result = (c10 + c20 * strain) * strain;
    if constexpr (kHasI2) result += c01 * (a * a * i.I2 - 3);
    return result;
  }
  void add_slopes(const Invariants& i, double share, Slopes& s) const {
    const Lanes root = inverse_cube_root(i.J), a = root * root, inverse_J = a * root;
    // Of Ī1, and of the energy by it.
    const Lanes by_J = (-2.0 / 3) * a * i.I1 * inverse_J, by_I1_J = (-2.0 / 3) * a * inverse_J;
    const Lanes first = share * (c10 + 2 * c20 * (a * i.I1 - 3));
    const double second = share * 2 * c20;
    s.I1 += first * a;
    s.J += first * by_J;
    s.I1_I1 += second * a * a;
    s.I1_J += first * by_I1_J + second * a * by_J;
    s.J_J += (-5.0 / 3) * first * by_J * inverse_J + second * by_J * by_J;
    if constexpr (kHasI2) {
      const Lanes c = share * c01 * a * a, c_J = (-4.0 / 3) * c * inverse_J;
      s.I2 += c;
      s.J += c_J * i.I2;
      s.I2_J += c_J;
      s.J_J += (-7.0 / 3) * c_J * i.I2 * inverse_J;
    }
  }
};

/// See dilatation.hpp.
struct VolumeTheta {
  static Lanes value(Lanes J) { return J - 1; }
  static void add_slopes(Lanes, Lanes pressure, Slopes& s) { s.J += pressure; }
};
struct LogVolumeTheta {
  static Lanes value(Lanes J) { return log(J); }
  static void add_slopes(Lanes J, Lanes pressure, Slopes& s) {
    const Lanes inverse_J = 1 / J;
    s.J += pressure * inverse_J;
    s.J_J -= pressure * inverse_J * inverse_J;
  }
};

/// ∂P/∂F while it is put together: a matrix of 3x3 blocks, column-major as block[j + 3 l].
struct Tangent81 {
  Matrix block[9];
};

template <class Energy, class Theta>
struct IsotropicLanes {
  Energy energy;
  explicit IsotropicLanes(const SplitBatchLaw& law) : energy(law) {}

  struct State {
    Matrix F, cof;
    Invariants i;
    double share;
    const double* pressure;  // of the first lane, or null
  };
  static State at(const Matrix& F, const EightPoints& points, int first) {
    const Matrix cof = cofactor(F);
    return {F,
            cof,
            {squared_norm(F), squared_norm(cof), dot(F[0], cof[0])},
            points.share,
            points.pressure == nullptr ? nullptr : points.pressure->lane + first};
  }

  Lanes energy_density(const State& s) const {
    Lanes W{};
    if (s.share != 0) W += s.share * energy.value(s.i);
    if (s.pressure != nullptr) W += load(s.pressure) * Theta::value(s.i.J);
    return W;
  }

  Slopes slopes(const State& s) const {
    Slopes d;
    if (s.share != 0) energy.add_slopes(s.i, s.share, d);
    if (s.pressure != nullptr) Theta::add_slopes(s.i.J, load(s.pressure), d);
    return d;
  }

  Matrix first_piola(const State& s) const { return first_piola(s, slopes(s)); }
  static Matrix first_piola(const State& s, const Slopes& d) {
    Matrix P = (2 * d.I1) * s.F + d.J * s.cof;
    if constexpr (Energy::kHasI2) P = P + d.I2 * second_invariant_gradient(s);
    return P;
  }

  void tangent(const State& s, Tangent81& C) const { tangent(s, slopes(s), C); }
  /// Of the gradients 2F, D = ∂I2/∂F and cof F, and of the second derivatives of I1, I2 and J.
  static void tangent(const State& s, const Slopes& d, Tangent81& C) {
    const Matrix& F = s.F;
    Matrix D;
    Symmetric FtF, FFt;
    if constexpr (Energy::kHasI2) {
      D = second_invariant_gradient(s);
      FtF = gram(F);
      FFt = gram(transposed(F));
    }
    // Blocks of ∂²J/∂F² are cross products with the third column: see cofactor.hpp.
    const Vector h[3] = {d.J * F[0], d.J * F[1], d.J * F[2]};
    for (int l = 0; l < 3; ++l) {
      const Vector by_F = (4 * d.I1_I1) * F[l] + (2 * d.I1_J) * s.cof[l];
      Vector by_cof = (2 * d.I1_J) * F[l] + d.J_J * s.cof[l], by_D{};
      if constexpr (Energy::kHasI2) {
        by_cof = by_cof + d.I2_J * D[l];
        by_D = d.I2_J * s.cof[l];
      }
      for (int j = l; j < 3; ++j) {
        Matrix B = outer(F[j], by_F) + outer(s.cof[j], by_cof);
        if constexpr (Energy::kHasI2) {
          B = B + outer(D[j], by_D) + outer(F[j], (4 * d.I2) * F[l]) -
              outer(F[l], (2 * d.I2) * F[j]);
          const Lanes cross = -2 * d.I2 * row(FtF, j)[l];
          for (int k = 0; k < 3; ++k) B[k][k] += cross;
        }
        if (j == l) {
          for (int k = 0; k < 3; ++k) B[k][k] += 2 * d.I1;
          if constexpr (Energy::kHasI2) {
            for (int k = 0; k < 3; ++k) {
              B[k] = B[k] - (2 * d.I2) * row(FFt, k);
              B[k][k] += 2 * d.I2 * s.i.I1;
            }
          }
        } else {
          const Vector& a = h[3 - j - l];
          add_cross(j - l == 1 ? a : -a, B);
        }
        C.block[j + 3 * l] = B;
        if (j != l) C.block[l + 3 * j] = transposed(B);
      }
    }
  }

  /// In the axes of F = U diag(σ) Vᵀ the tangent falls apart, as that of every isotropic law: a 3x3
  /// matrix of the stretches, and a twist and a flip in each plane [Smith 2018, sec. 4].
  void projected_tangent(const State& s, Tangent81& C) const { projected_tangent(s, slopes(s), C); }
  static void projected_tangent(const State& s, const Slopes& d, Tangent81& C) {
    const Polar p = polar(s.F);
    const Eigen3 e = eigen(p.T);
    const Matrix &U = e.vectors, V = transposed(p.R) * U;
    const Lanes(&sigma)[3] = e.values;
    Vector u, v, c;  // derivatives of I1, I2, J by the stretches
    Lanes squares[3];
    for (int k = 0; k < 3; ++k) squares[k] = sigma[k] * sigma[k];
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      u[k] = 2 * sigma[k];
      v[k] = 2 * sigma[k] * (squares[i] + squares[j]);
      c[k] = sigma[i] * sigma[j];
    }
    const auto mixed = [&](int i, int j) {
      Lanes result =
          d.I1_I1 * u[i] * u[j] + d.I1_J * (u[i] * c[j] + c[i] * u[j]) + d.J_J * c[i] * c[j];
      if constexpr (Energy::kHasI2) result += d.I2_J * (v[i] * c[j] + c[i] * v[j]);
      return result;
    };
    Symmetric stretches;
    Lanes same[3], crossed[3];  // ∂P_ij/∂F_ij and ∂P_ij/∂F_ji in the plane of axis k
    const Lanes zero{};         // first in max(): what is not a number stays so
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      Lanes on_diagonal = 2 * d.I1, beside = d.J * sigma[k], of_flip = 2 * d.I1, of_J = beside;
      if constexpr (Energy::kHasI2) {
        on_diagonal += 2 * d.I2 * (squares[i] + squares[j]);
        beside += 4 * d.I2 * c[k];
        of_flip += 2 * d.I2 * squares[k];
        of_J += 2 * d.I2 * c[k];
      }
      stretches.v[k] = on_diagonal + mixed(k, k);
      stretches.v[k == 2 ? 3 : k == 1 ? 4 : 5] = beside + mixed(i, j);
      const Lanes flip = max(zero, of_flip - of_J), twist = max(zero, of_flip + of_J);
      same[k] = 0.5 * (flip + twist);
      crossed[k] = 0.5 * (flip - twist);
    }
    const Eigen3 of_stretches = eigen(stretches);
    Lanes kept[3];
    for (int k = 0; k < 3; ++k) kept[k] = max(zero, of_stretches.values[k]);
    rotate(compose(of_stretches.vectors, kept), same, crossed, U, V, C);
  }

 private:
  /// ∂I2/∂F = 2 (I1 F − F FᵀF)
  static Matrix second_invariant_gradient(const State& s) {
    const Matrix FFtF = s.F * (transposed(s.F) * s.F);
    return (2 * s.i.I1) * s.F - all(2) * FFtF;
  }
  /// AᵀA
  static Symmetric gram(const Matrix& A) {
    return {{dot(A[0], A[0]), dot(A[1], A[1]), dot(A[2], A[2]), dot(A[1], A[0]), dot(A[2], A[0]),
             dot(A[2], A[1])}};
  }
  /// B += [a]×
  static void add_cross(const Vector& a, Matrix& B) {
    B[0][1] += a[2];
    B[0][2] -= a[1];
    B[1][0] -= a[2];
    B[1][2] += a[0];
    B[2][0] += a[1];
    B[2][1] -= a[0];
  }

  /// From the axes of F to those of space: Σ T_pq Y_pqᵀ with T_pq = U_p V_qᵀ, Y_pq = Σ_rs C_pq,rs
  /// T_rs.
  static void rotate(const Symmetric& A, const Lanes (&same)[3], const Lanes (&crossed)[3],
                     const Matrix& U, const Matrix& V, Tangent81& C) {
    Matrix T[3][3];
    for (int p = 0; p < 3; ++p) {
      for (int q = 0; q < 3; ++q) T[p][q] = outer(U[p], V[q]);
    }
    for (Matrix& block : C.block) block = Matrix{};
    for (int p = 0; p < 3; ++p) {
      for (int q = 0; q < 3; ++q) {
        Matrix Y;
        if (p == q) {
          const Vector a = row(A, p);
          Y = a[0] * T[0][0] + a[1] * T[1][1] + a[2] * T[2][2];
        } else {
          const int k = 3 - p - q;
          Y = same[k] * T[p][q] + crossed[k] * T[q][p];
        }
        for (int l = 0; l < 3; ++l) {
          for (int j = l; j < 3; ++j) {
            C.block[j + 3 * l] = C.block[j + 3 * l] + outer(T[p][q][j], Y[l]);
          }
        }
      }
    }
    for (int l = 0; l < 3; ++l) {
      for (int j = l + 1; j < 3; ++j) C.block[l + 3 * j] = transposed(C.block[j + 3 * l]);
    }
  }
};

}  // namespace
}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
