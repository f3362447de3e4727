#pragma once

#include <memory>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

class MuscleFibre;  // muscle_fibre.hpp

/// Force–velocity of the fibres of a muscle, in each element of a mesh of linear tetrahedra: what
/// they pull less while they shorten, and more while they lengthen (MuscleFibre::drag), beside the
/// elastic law that has their pull at rest. It only takes energy.
class FibreDrag {
 public:
  /// @param fibres  one an element, none of them 0
  /// @param matrix  what add_damping() will add to: one block row a node, with the couplings of the
  ///                elements at least
  /// @throws std::invalid_argument as Elasticity does
  FibreDrag(const Positions& X, const Tetrahedra& tets, const FibreDirections& fibres,
            const MuscleFibre& law, const BlockMatrix& matrix);

  /// f += the force [N] that moves the shape x on with the velocities v [m/s].
  void add_force(const Positions& x, const Positions& v, double activation, Positions& f) const;
  /// What a matrix took an element's factor f_v for: factor + slope (w − speed).
  struct Line {
    double speed = 0, factor = 1, slope = 0;  // [-]
  };
  using Lines = std::vector<Line>;  // one an element; empty: none

  /// D += scale * ∂f/∂v [N s/m]: symmetric, positive semidefinite.
  ///
  /// Hill's curve is steep where fibres hardly move and flat where they are fast: with its slope
  /// there Newton's iteration is thrown back and forth. So the factor is an unknown beside the
  /// velocities, which goes along the line of the matrix before: see force_velocity_slope(). What
  /// is solved stays the same, and where the iteration ends both slopes are one.
  /// @param lines  of the matrix before; then of this one
  void add_damping(const Positions& x, const Positions& v, double activation, double scale,
                   Lines& lines, BlockMatrix& D) const;
  /// f += ∂f/∂v u.
  void add_product(const Positions& x, const Positions& v, double activation, const Positions& u,
                   Positions& f) const;
  /// What is lost [W].
  double power(const Positions& x, const Positions& v, double activation) const;

 private:
  /// Calls function(element, direction of its fibres, their drag, λ̇).
  template <class Function>
  void for_each_fibre(const Positions& x, const Positions& v, double activation,
                      Function&& function) const;

  Tetrahedra tets_;
  std::shared_ptr<const MuscleFibre> law_;
  Eigen::Matrix4Xd along_;  // ∂N/∂X · a₀ of each element's nodes [1/m]: F a₀ = Σ x ∂N/∂X · a₀
  Eigen::VectorXd volume_;  // of each element, times the density of its fibres [m³]
  std::vector<int> slots_;  // 16 an element, 4b + a
};

}  // namespace articular::fem
