#pragma once

#include <vector>

#include "fem/base/types.hpp"
#include "fem/element/stencil_batches.hpp"
#include "fem/element/stencil_pairs.hpp"
#include "fem/material/viscosity.hpp"
#include "fem/simd/viscosity_kernels.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

class SmoothedElasticity;

/// Kelvin–Voigt dashpots in a mesh of linear tetrahedra: one in each element; or, of a smoothed
/// one, in the domains and elements where it takes the energy of its distortion, with the same
/// shares.
///
/// Holds work memory: one object serves one thread at a time.
class Dashpots {
 public:
  /// @param matrix  what add_tangent() will add to: one block row a node, with the couplings of the
  ///                elements at least
  /// @throws std::invalid_argument as Elasticity does
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
  struct Octet;
  /// Calls function(octet) for batches of domains, or of elements.
  template <class Function>
  void for_each_octet(int begin, int end, double share, const Positions& x, const Positions& v,
                      Function function) const;
  /// For a chunk, with the shares of domains and elements.
  template <class Function>
  void for_each_octet(const StencilBatches::Chunk& chunk, const Positions& x, const Positions& v,
                      Function function) const;
  /// @param visit  visit(chunk, add): calls add(octet) for those of a chunk that have a part in K
  template <class Visit>
  void add_tangents(double damping, double stiffness, const StencilPairs& pairs, BlockMatrix& K,
                    Visit visit) const;
  Dashpots(StencilBatches stencils, double element_share, const KelvinVoigt& law);

  KelvinVoigt law_;
  double element_share_;  // [-]; of the domains what is left of 1
  InstructionSet instruction_set_ = best_instruction_set();
  StencilBatches stencils_;
  StencilPairs pairs_, plain_pairs_;
};

}  // namespace articular::fem
