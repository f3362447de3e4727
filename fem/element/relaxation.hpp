#pragma once

#include <memory>
#include <vector>

#include "fem/base/tangent.hpp"
#include "fem/element/distortion_points.hpp"
#include "fem/material/prony_term.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

struct AnyMaterial;

/// Relaxation of the distortion's stress by a Prony series, in the rest frame, which rotations
/// leave alone [Simo 1987; Holzapfel 2000, ch. 6.10]. S0 = F⁻¹ P0 is the second Piola–Kirchhoff
/// stress of a sudden strain; each term has an internal variable L_i that lags
/// behind it:
///
///   S = S0 − Σ g_i L_i,   dL_i/dt = (S0 − L_i)/τ_i
///
/// so that after a sudden strain S/S0 = 1 − Σ g_i (1 − exp(−t/τ_i)), and after long rest
/// (1 − Σ g_i) S0. Dilatation does not relax. The internal variables are part of a simulation's
/// state: whatever integrates that in time integrates them too, to its own order.
///
/// This is what relaxation adds to elements of a law: force −Σ_k V_k F (Σ g_i L_i) ∂N/∂X.
///
/// [Simo 1987] Simo. On a fully three-dimensional finite-strain viscoelastic damage model.
///             Comput. Meth. Appl. Mech. Engng 60:153.
/// [Holzapfel 2000] Holzapfel. Nonlinear Solid Mechanics. Wiley.
class Relaxation {
 public:
  /// @param matrix  what add_stiffness() will add to: one block row a node, with the couplings of
  ///                the points at least
  /// @throws std::invalid_argument naming the term that is out of range, or the sum of the weights
  ///         unless it is below 1
  Relaxation(std::vector<PronyTerm> terms, const AnyMaterial& law, DistortionPoints points,
             const BlockMatrix& matrix);

  int num_points() const { return points_.size(); }
  int num_terms() const { return static_cast<int>(terms_.size()); }
  /// Numbers of all internal variables: six (xx yy zz xy yz xz) a point, all points of one term
  /// after the other.
  int num_internal_variables() const { return 6 * num_points() * num_terms(); }
  const std::vector<PronyTerm>& terms() const { return terms_; }

  /// S0 [Pa], 6 a point.
  void stress(const Positions& x, double activation, Eigen::VectorXd& S0) const;
  /// dL/dt [Pa/s]
  void rate(const Eigen::VectorXd& S0, const Eigen::VectorXd& internal_variables,
            Eigen::Ref<Eigen::VectorXd> rate) const;
  /// L after a long time at S0.
  void settle(const Eigen::VectorXd& S0, Eigen::VectorXd& internal_variables) const;

  /// The energy [J] that the force of settled internal variables is the gradient of: −Σ g_i W_d.
  double settled_energy(const Positions& x, double activation) const;
  /// f += scale times the force [N] of the internal variables. It is linear in them.
  void add_force(const Positions& x, const Eigen::VectorXd& internal_variables, double scale,
                 Positions& f) const;
  /// K += scale times the derivative of that force by x, for internal variables that a step of the
  /// length h [s] ends with, L = (L_before + h/τ S0(x)) / (1 + h/τ), as in every implicit scheme; h
  /// = infinity: internal variables that rest. Symmetric. With the stiffness of the law it is
  /// positive definite where that is, but for the part of the internal variables that turns with F,
  /// which Tangent::Projected leaves out.
  /// @param S0  of x
  void add_stiffness(const Positions& x, double activation, Tangent tangent,
                     const Eigen::VectorXd& S0, const Eigen::VectorXd& internal_variables, double h,
                     double scale, BlockMatrix& K) const;

  /// Per element: σ += −F (Σ g_i L_i) Fᵀ/J. @param cauchy_stress  6 x M (xx yy zz xy yz xz) [Pa]
  void add_cauchy_stress(const Positions& x, const Eigen::VectorXd& internal_variables,
                         Eigen::MatrixXd& cauchy_stress) const;

 private:
  Mat3 gradient(const Positions& x, int k) const;
  /// Σ g_i L_i of a point.
  Mat3 relaxed(const Eigen::VectorXd& internal_variables, int k) const;

  std::vector<PronyTerm> terms_;
  std::shared_ptr<const AnyMaterial> law_;
  DistortionPoints points_;
  std::vector<int> slots_;  // of all pairs (a, b) of each point, one a after the other
};

}  // namespace articular::fem
