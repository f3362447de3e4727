#pragma once

#include "fem/material/material.hpp"

namespace articular::fem {

/// A Kelvin–Voigt dashpot in the rest frame, beside the elastic law (viscosity_kernels.hpp):
///
///   S_v = 2η dev Ė + ζ tr(Ė) I,   Ė = sym(FᵀḞ), the rate of the Green–Lagrange strain
///   P_v = F S_v
///
/// A rigid rotation, of any speed, neither makes stress nor changes it (Ė does not feel it), and
/// the dissipation P_v : Ḟ = 2η |dev Ė|² + ζ tr²Ė is never negative [Simo 1998, ch. 10].
///
/// [Simo 1998] Simo, Hughes. Computational Inelasticity. Springer.
class KelvinVoigt {
 public:
  /// @param eta   shear viscosity [Pa s], not negative
  /// @param zeta  bulk viscosity [Pa s], not negative
  /// @throws std::invalid_argument naming the one that is out of range
  KelvinVoigt(double eta, double zeta)
      : eta_(checked_not_negative(eta, "shear viscosity", "Pa s")),
        lambda_(checked_not_negative(zeta, "bulk viscosity", "Pa s") - 2 * eta / 3) {}

  double eta() const { return eta_; }
  double lambda() const { return lambda_; }  // ζ − 2η/3

 private:
  double eta_, lambda_;  // [Pa s]
};

// Rayleigh's damping D = α M + β K, made objective: K is that of the rest state and moves with the
// element as a dashpot, so that a rotation is damped by α alone and the matrix is positive
// semidefinite where the tangent K is not. About rest it is β K, and a mode of the circular
// frequency ω decays with the damping ratio α/(2ω) + βω/2. α also slows a free flight.

/// The dashpot of β K, β [s], for a material with these moduli [Pa] at rest: η = β μ, ζ = β κ.
/// @throws std::invalid_argument for a negative β
KelvinVoigt stiffness_damping(double beta, double shear_modulus, double bulk_modulus);

/// f += α m v [N], α [1/s]. @param lumped_mass  one entry a node [kg]
void add_mass_damping(double alpha, const Eigen::VectorXd& lumped_mass, const Positions& v,
                      Positions& f);

}  // namespace articular::fem
