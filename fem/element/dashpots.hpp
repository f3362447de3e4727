#pragma once

#include <memory>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

class KelvinVoigt;

/// A Kelvin–Voigt dashpot in each element of a mesh of linear tetrahedra.
class Dashpots {
 public:
  /// @param matrix  what add_tangent() will add to: one block row a node, with the couplings of the
  ///                elements at least
  /// @throws std::invalid_argument as Elasticity does
  Dashpots(const Positions& X, const Tetrahedra& tets, const KelvinVoigt& law,
           const BlockMatrix& matrix);

  /// f += the force [N] that moves the shape x on with the velocities v [m/s].
  void add_force(const Positions& x, const Positions& v, Positions& f) const;
  /// K += damping * ∂f/∂v + stiffness * the symmetric part of ∂f/∂x, at the velocities v. The first
  /// is symmetric and positive semidefinite; the second is neither, and 0 at rest.
  /// @param damping, stiffness  [1/s], [-] for a K in [N/m]
  void add_tangent(const Positions& x, const Positions& v, double damping, double stiffness,
                   BlockMatrix& K) const;
  /// What is lost [W].
  double power(const Positions& x, const Positions& v) const;

 private:
  Tetrahedra tets_;
  std::shared_ptr<const KelvinVoigt> law_;
  std::vector<Mat3> inverse_edges_;  // [1/m]
  std::vector<double> volume_;       // [m³]
  std::vector<int> slots_;           // 16 an element, 4b + a
};

}  // namespace articular::fem
