#pragma once

#include <cmath>

#include "fem/base/cofactor.hpp"
#include "fem/base/types.hpp"

/// Invariants of the deformation without its change of volume, F̄ = J^(−1/3) F, with the
/// derivatives that energies of them need. Defined for J > 0; not a number elsewhere.
namespace articular::fem {

/// A function of F with its first two derivatives.
struct Jet {
  double value;
  Mat3 gradient;  // ∂/∂F
  Mat9 hessian;   // ∂²/∂vec(F)²
};

/// A ⊗ 1, the matrix of dF ↦ dF A for a symmetric A.
inline Mat9 on_columns(const Mat3& A) {
  Mat9 result;
  for (int j = 0; j < 3; ++j) {
    for (int l = 0; l < 3; ++l) result.block<3, 3>(3 * j, 3 * l) = A(j, l) * Mat3::Identity();
  }
  return result;
}

/// f(I) from f and its first two derivatives at I.
inline Jet composed(const Jet& I, double f, double df, double ddf) {
  const Vec9 g = I.gradient.reshaped();
  return {f, df * I.gradient, df * I.hessian + ddf * g * g.transpose()};
}

inline Jet product(const Jet& A, const Jet& B) {
  const Vec9 a = A.gradient.reshaped(), b = B.gradient.reshaped();
  return {A.value * B.value, A.value * B.gradient + B.value * A.gradient,
          A.value * B.hessian + B.value * A.hessian + a * b.transpose() + b * a.transpose()};
}

/// J^p I from the jet of I.
inline Jet times_power_of_volume(const Jet& I, double p, const Mat3& F) {
  const double J = F.determinant(), scale = std::pow(J, p);
  const Vec9 c = cofactor(F).reshaped(), g = I.gradient.reshaped();
  const double first = p / J, second = p * (p - 1) / (J * J);  // derivatives of J^p, per J^p
  Jet result;
  result.value = scale * I.value;
  result.gradient = scale * (I.gradient + first * I.value * cofactor(F));
  result.hessian =
      scale * (I.hessian + first * (c * g.transpose() + g * c.transpose()) +
               I.value * (second * c * c.transpose() + first * cofactor_derivative(F)));
  return result;
}

/// I1 = tr FᵀF
inline Jet first_invariant(const Mat3& F) { return {F.squaredNorm(), 2 * F, 2 * Mat9::Identity()}; }

/// I2 = |cof F|². cof F is quadratic in F, so that its derivative contracted with a fixed C is
/// the derivative at C.
inline Jet second_invariant(const Mat3& F) {
  const Mat3 C = cofactor(F);
  const Mat9 H = cofactor_derivative(F);
  const Vec9 gradient = 2 * H * C.reshaped();
  return {C.squaredNorm(), gradient.reshaped(3, 3), 2 * H * H + 2 * cofactor_derivative(C)};
}

/// Ī1 = J^(−2/3) I1
inline Jet first_isochoric_invariant(const Mat3& F) {
  return times_power_of_volume(first_invariant(F), -2.0 / 3, F);
}

/// Ī2 = J^(−4/3) I2
inline Jet second_isochoric_invariant(const Mat3& F) {
  return times_power_of_volume(second_invariant(F), -4.0 / 3, F);
}

}  // namespace articular::fem
