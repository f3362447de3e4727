#pragma once

#include "fem/material/isochoric.hpp"

/// Invariants of the deformation of a fibre with the unit direction a0 at rest [Weiss 1996], with
/// C = FᵀF. None feels the sign of a0.
///
/// [Weiss 1996] Weiss, Maker, Govindjee. Finite element implementation of incompressible,
///              transversely isotropic hyperelasticity. Comput. Methods Appl. Mech. Eng. 135.
namespace articular::fem {

/// I4 = a0·C a0 = |F a0|², the square of the stretch of the fibre
Jet fourth_invariant(const Mat3& F, const Vec3& a0);

/// ∂I5/∂F of I5 = a0·C² a0 = |C a0|²
Mat3 fifth_invariant_gradient(const Mat3& F, const Vec3& a0);

/// I5. With w = C a0 the first variation of w is dw = dFᵀ F a0 + Fᵀ dF a0, and its second is
/// 2 dFᵀ dF a0.
Jet fifth_invariant(const Mat3& F, const Vec3& a0);

/// λ = |F a0|, the stretch of the fibre
double fibre_stretch(const Mat3& F, const Vec3& a0);
Mat3 fibre_stretch_gradient(const Mat3& F, const Vec3& a0);
Jet fibre_stretch_jet(const Mat3& F, const Vec3& a0);

/// λ̄ = J^(−1/3) |F a0|, the stretch of the fibre without the change of volume, J > 0
double isochoric_fibre_stretch(const Mat3& F, const Vec3& a0);
Mat3 isochoric_fibre_stretch_gradient(const Mat3& F, const Vec3& a0);
Jet isochoric_fibre_stretch_jet(const Mat3& F, const Vec3& a0);

}  // namespace articular::fem
