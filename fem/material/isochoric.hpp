#pragma once

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
Mat9 on_columns(const Mat3& A);

/// f(I) from f and its first two derivatives at I.
Jet composed(const Jet& I, double f, double df, double ddf);

Jet product(const Jet& A, const Jet& B);

/// J^p I from the jet of I.
Jet times_power_of_volume(const Jet& I, double p, const Mat3& F);

/// I1 = tr FᵀF
Jet first_invariant(const Mat3& F);

/// I2 = |cof F|². cof F is quadratic in F, so that its derivative contracted with a fixed C is
/// the derivative at C.
Jet second_invariant(const Mat3& F);

/// Ī1 = J^(−2/3) I1
Jet first_isochoric_invariant(const Mat3& F);

/// Ī2 = J^(−4/3) I2
Jet second_isochoric_invariant(const Mat3& F);

}  // namespace articular::fem
