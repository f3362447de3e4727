#pragma once

#include <array>

#include "fem/material/fibre_invariants.hpp"
#include "fem/material/material.hpp"

namespace articular::fem {

/// acosh²(y) and its first two derivatives. Smooth across y = 1, where the closed form is 0/0: with
/// z = y − 1 it is −2 Σ (−2z)ⁿ/(n² binomial(2n, n)), n ≥ 1.
std::array<double, 3> squared_acosh(double y);

/// Resistance of muscle to shear along and across its fibres [Blemker 2005], in the strains of
/// [Criscione 2001], and an isotropic ground substance (not in that paper, so 0 there):
///
///   Ψ_d = G1 B1² + G2 B2² + c10 (Ī1 − 3)
///   B1² = I5/I4² − 1                            shear along the fibre
///   cosh B2 = (I1 I4 − I5)/(2 J √I4)            shear across it: B2 = ln of the ratio of the
///                                               principal stretches of the cross section
///
/// B1 and B2 do not feel a change of volume: the powers of J that make invariants isochoric cancel.
/// Shear moduli at small strain: 2 (G1 + c10) along the fibre, 2 (G2 + c10) across. Without c10
/// nothing but the fibre itself resists a stretch along it with even contraction of the sides,
/// and a slack fibre does not: the stiffness is singular. Defined for J > 0.
///
/// [Criscione 2001] Criscione, Douglas, Hunter. Physically based strain invariant set for materials
///                  exhibiting transversely isotropic behavior. J. Mech. Phys. Solids 49.
class FibreShear {
 public:
  /// @param a0              unit vector at rest
  /// @param G1, G2, c10     [Pa], checked by the material that makes this
  FibreShear(double G1, double G2, double c10, const Vec3& a0)
      : G1_(G1), G2_(G2), c10_(c10), a0_(a0) {}

  double shear_modulus() const { return G1_ + G2_ + 2 * c10_; }  // [Pa], mean of the two

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3& F) const;
  /// @param I  of the same fibre
  void add_slopes(const Invariants& I, InvariantSlopes& energy) const;

 private:
  double G1_, G2_, c10_;  // [Pa]
  Vec3 a0_;
};
static_assert(Hyperelastic<FibreShear>);

}  // namespace articular::fem
