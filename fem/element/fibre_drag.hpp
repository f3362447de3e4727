#pragma once

#include <memory>
#include <vector>

#include "fem/element/moving_stencils.hpp"

namespace articular::fem {

class MuscleFibre;  // muscle_fibre.hpp

/// Force–velocity of the fibres of a muscle, at the points of MovingStencils: what they pull less
/// while they shorten, and more while they lengthen (MuscleFibre::drag), beside the elastic law
/// that has their pull at rest. It only takes energy.
///
/// Smoothed elements have it where they have that pull: elsewhere a drag could be more than the
/// pull, and a fibre that shortens would push.
///
/// Holds work memory: one object serves one thread at a time.
class FibreDrag {
 public:
  /// @param fibres  one an element, none of them 0
  /// @param matrix  what add_tangent() will add to: see MovingStencils, which also throws
  FibreDrag(const Positions& X, const Tetrahedra& tets, const FibreDirections& fibres,
            const MuscleFibre& law, const BlockMatrix& matrix);
  /// For matrices of make_matrix(), and of make_plain_matrix().
  /// @param smoothed  of one material, with fibres
  FibreDrag(const SmoothedElasticity& smoothed, const MuscleFibre& law);

  /// f += the force [N] that moves the shape x on with the velocities v [m/s].
  void add_force(const Positions& x, const Positions& v, double activation, Positions& f) const;
  /// What a matrix took a fibre's factor f_v for: factor + slope (w − speed).
  struct Line {
    double speed = 0, factor = 1, slope = 0;  // [-]
  };
  using Lines = std::vector<Line>;  // one a point; empty: none

  /// K += damping * ∂f/∂v + stiffness * the symmetric part of ∂f/∂x. The first is symmetric and
  /// positive semidefinite. The second is not: fibres that shorten pull with less than the elastic
  /// law has, whose stiffness it takes back.
  /// @param damping, stiffness  [1/s], [-] for a K in [N/m]
  ///
  /// Hill's curve is steep where fibres hardly move and flat where they are fast: with its slope
  /// there Newton's iteration is thrown back and forth. So the factor is an unknown beside the
  /// velocities, which goes along the line of the matrix before: see force_velocity_slope(). What
  /// is solved stays the same, and where the iteration ends both slopes are one.
  /// @param lines  of the matrix before; then of this one
  void add_tangent(const Positions& x, const Positions& v, double activation, double damping,
                   double stiffness, Lines& lines, BlockMatrix& K) const;
  /// For preconditioners of smoothed elements: K += damping * ∂f/∂v, as if all of it were in the
  /// elements.
  /// @param lines  that add_tangent() has set for this motion
  void add_plain_damping(const Positions& x, const Positions& v, double activation, double damping,
                         const Lines& lines, BlockMatrix& K) const;
  /// f += ∂f/∂v u.
  void add_product(const Positions& x, const Positions& v, double activation, const Positions& u,
                   Positions& f) const;
  /// What is lost [W].
  double power(const Positions& x, const Positions& v, double activation) const;

 private:
  using Octet = MovingStencils::Octet;
  struct Fibre;
  Fibre fibre(const Octet& octet, int lane, double activation) const;
  Mat3 stiffness(const Fibre& fibre, double activation, double by_rate) const;
  auto stress(double activation) const;

  std::shared_ptr<const MuscleFibre> law_;
  MovingStencils stencils_;
  FibreDirections fibres_;  // of each point: eight a batch, as long as they are dense
};

}  // namespace articular::fem
