#pragma once

#include "fem/material/invariants.hpp"

/// Stretches of a fibre with the unit direction a0 at rest [Weiss 1996], with
/// C = FᵀF. None feels the sign of a0.
///
/// [Weiss 1996] Weiss, Maker, Govindjee. Finite element implementation of incompressible,
///              transversely isotropic hyperelasticity. Comput. Methods Appl. Mech. Eng. 135.
namespace articular::fem {

/// ∂I5/∂F of I5 = a0·C² a0 = |C a0|²
Mat3 fifth_invariant_gradient(const Mat3& F, const Vec3& a0);

/// λ = |F a0|, the stretch of the fibre
double fibre_stretch(const Mat3& F, const Vec3& a0);
Mat3 fibre_stretch_gradient(const Mat3& F, const Vec3& a0);

/// λ̄ = J^(−1/3) |F a0|, the stretch of the fibre without the change of volume, J > 0
double isochoric_fibre_stretch(const Mat3& F, const Vec3& a0);
Mat3 isochoric_fibre_stretch_gradient(const Mat3& F, const Vec3& a0);

}  // namespace articular::fem
