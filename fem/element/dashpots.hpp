#pragma once

#include "fem/element/moving_stencils.hpp"
#include "fem/material/viscosity.hpp"

namespace articular::fem {

/// Kelvin–Voigt dashpots in a mesh of linear tetrahedra, at the points of MovingStencils.
///
/// Holds work memory: one object serves one thread at a time.
class Dashpots {
 public:
  /// @param matrix  what add_tangent() will add to: see MovingStencils, which also throws
  Dashpots(const Positions& X, const Tetrahedra& tets, const KelvinVoigt& law,
           const BlockMatrix& matrix);
  /// For matrices of make_matrix(), and of make_plain_matrix().
  /// @param smoothed  of one material
  Dashpots(const SmoothedElasticity& smoothed, const KelvinVoigt& law);

  /// f += the force [N] that moves the shape x on with the velocities v [m/s].
  void add_force(const Positions& x, const Positions& v, Positions& f) const;
  /// K += damping * ∂f/∂v + stiffness * the symmetric part of ∂f/∂x, at the velocities v. The first
  /// is symmetric and positive semidefinite; the second is neither, and 0 at rest.
  /// @param damping, stiffness  [1/s], [-] for a K in [N/m]
  void add_tangent(const Positions& x, const Positions& v, double damping, double stiffness,
                   BlockMatrix& K) const;
  /// For preconditioners of smoothed elements: K += damping * ∂f/∂v, as if all dashpots were in the
  /// elements.
  void add_plain_damping(const Positions& x, double damping, BlockMatrix& K) const;
  /// What is lost [W].
  double power(const Positions& x, const Positions& v) const;

 private:
  using Octet = MovingStencils::Octet;
  auto stress() const;
  auto tangent(double damping, double stiffness) const;

  KelvinVoigt law_;
  MovingStencils stencils_;
};

}  // namespace articular::fem
