#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/sparse/signed_cholesky.hpp"

namespace articular::fem {

/// What the pressure needs to know of a material.
struct PressureModuli {
  double kappa, mu;  // bulk and shear modulus at small strain [Pa]
};

/// Continuous nodal pressures p on linear tetrahedra, stabilised by polynomial pressure projection
/// [Dohrmann 2004]: the compliance
///
///   A = Σ_e M_e/κ + τ/μ S_e,   M_e = V_e/20 (I + 11ᵀ),   S_e = V_e/20 (I − ¼ 11ᵀ)   [m³/Pa]
///
/// between the pressure and the nodal changes of volume b = A p. M_e is the mass matrix, S_e
/// measures how far the pressure of an element is from a constant: without it equal orders of
/// displacement and pressure oscillate. A is constant, symmetric and positive definite, and is
/// factored here once.
///
/// Pressure is positive in tension. It jumps between materials: a node that touches two of them has
/// a pressure in each.
///
/// [Dohrmann 2004] Dohrmann, Bochev. A stabilized finite element method for the Stokes problem
/// based
///                 on polynomial pressure projections. Int. J. Numer. Meth. Fluids 46:183.
class NodalPressure {
 public:
  NodalPressure() = default;
  /// @param volume    of each element [m³]
  /// @param material  of each element, an index into `moduli`
  /// @param tau       τ [-], > 0
  NodalPressure(int num_nodes, const Tetrahedra& tets, std::span<const double> volume,
                std::span<const int> material, std::span<const PressureModuli> moduli, double tau);

  int size() const { return static_cast<int>(node_.size()); }
  /// The pressures of each element's corners, as `tets` has their nodes.
  const Tetrahedra& of_corner() const { return of_corner_; }
  /// The node of each pressure, and its material. Those of one material are neighbours.
  const std::vector<int>& node() const { return node_; }
  const std::vector<int>& material() const { return material_; }
  const SymmetricMatrix& compliance() const { return A_; }
  /// The largest κ/μ of its materials.
  double stiffness_ratio() const { return stiffness_ratio_; }
  /// p ← A⁻¹ p
  void solve(Eigen::VectorXd& p) const { factor_.solve(p); }

 private:
  std::vector<int> node_, material_;
  Tetrahedra of_corner_;
  SymmetricMatrix A_;
  double stiffness_ratio_ = 0;
  SignedCholesky<double> factor_;
};

}  // namespace articular::fem
