#pragma once

#include <cassert>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/element/stencil_batches.hpp"
#include "fem/element/stencil_pairs.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

class SmoothedElasticity;

/// Where the motion of a mesh of linear tetrahedra makes stress: one point in each element; or, of
/// smoothed ones, the domains and elements where they take the energy of their distortion, with the
/// same shares. Laws are given as functions of eight points.
///
/// Holds work memory: one object serves one thread at a time.
class MovingStencils {
 public:
  /// @param matrix  what add_tangent() will add to: one block row a node, with the couplings of the
  ///                elements at least
  /// @throws std::invalid_argument as Elasticity does
  MovingStencils(const Positions& X, const Tetrahedra& tets, const BlockMatrix& matrix);
  /// For matrices of make_matrix(), and of make_plain_matrix().
  /// @param smoothed  of one material
  explicit MovingStencils(const SmoothedElasticity& smoothed);

  /// Eight points that move on. Of `share` is what a law gives.
  struct Octet {
    int index;  // among the batches of stencils()
    StencilBatch batch;
    double share;
    const Eight *F, *rate;  // F and Ḟ [1/s], 9 each, column-major
  };

  const StencilBatches& stencils() const { return stencils_; }
  bool are_elements(int batch) const { return of_elements_[static_cast<std::size_t>(batch)]; }
  InstructionSet instruction_set() const { return instruction_set_; }

  /// f += Σ V P ∂N/∂X [N] at the shape x with the velocities v [m/s].
  /// @param stress  stress(octet, P) sets P [Pa], 9
  template <class Stress>
  void add_force(const Positions& x, const Positions& v, Stress stress, Positions& f) const {
    for_each_octet(x, v, [&](const Octet& octet) {
      Eight P[9];
      stress(octet, P);
      kernels().add_force(octet.batch, P, f.data());
    });
  }

  /// Σ V P : Ḟ [W]
  template <class Stress>
  double power(const Positions& x, const Positions& v, Stress stress) const {
    double sum = 0;
    for_each_octet(x, v, [&](const Octet& octet) {
      Eight P[9];
      stress(octet, P);
      for (int lane = 0; lane < octet.batch.count; ++lane) {
        double density = 0;
        for (int k = 0; k < 9; ++k) density += P[k].lane[lane] * octet.rate[k].lane[lane];
        sum += octet.batch.volume->lane[lane] * density;
      }
    });
    return sum;
  }

  /// K += Σ V ∂N/∂X · C · ∂N/∂X
  /// @param tangent  tangent(octet, C) sets entry (m, n) in C[m + 9 n], symmetric
  template <class Tangent>
  void add_tangent(const Positions& x, const Positions& v, Tangent tangent, BlockMatrix& K) const {
    add_tangents(pairs_, tangent, K, [&](const StencilBatches::Chunk& chunk, const auto& add) {
      for_each_octet(chunk, x, v, add);
    });
  }

  /// For preconditioners of smoothed elements: as if all of it were in the elements.
  template <class Tangent>
  void add_plain_tangent(const Positions& x, const Positions& v, Tangent tangent,
                         BlockMatrix& K) const {
    add_tangents(plain_pairs_, tangent, K,
                 [&](const StencilBatches::Chunk& chunk, const auto& add) {
                   for_each_octet(chunk.elements, chunk.end, 1, x, v, add);
                 });
  }

 private:
  MovingStencils(StencilBatches stencils, double element_share);
  const StencilKernels& kernels() const { return stencil_kernels(instruction_set_); }

  template <class Function>
  void for_each_octet(int begin, int end, double share, const Positions& x, const Positions& v,
                      Function function) const {
    for (int i = begin; i < end; ++i) {
      const StencilBatch batch = stencils_.batch(i);
      Eight F[9], rate[9];
      kernels().deformation_gradient(batch, x.data(), F);
      kernels().deformation_gradient(batch, v.data(), rate);
      function(Octet{i, batch, share, F, rate});
    }
  }

  template <class Function>
  void for_each_octet(const StencilBatches::Chunk& chunk, const Positions& x, const Positions& v,
                      Function function) const {
    for_each_octet(chunk.begin, chunk.elements, 1 - element_share_, x, v, function);
    for_each_octet(chunk.elements, chunk.end, element_share_, x, v, function);
  }

  template <class Function>
  void for_each_octet(const Positions& x, const Positions& v, Function function) const {
    for (const StencilBatches::Chunk& chunk : stencils_.chunks())
      for_each_octet(chunk, x, v, function);
  }

  /// @param visit  visit(chunk, add): calls add(octet) for those of a chunk that have a part in K
  template <class Tangent, class Visit>
  void add_tangents(const StencilPairs& pairs, Tangent tangent, BlockMatrix& K, Visit visit) const {
    assert(K.pattern_id() == pairs.pattern_id());
    int number = 0;
    for (const StencilBatches::Chunk& chunk : stencils_.chunks()) {
      const PairSums sums = pairs.zero_sums(number, kernels());
      visit(chunk, [&](const Octet& octet) {
        Eight C[81];
        tangent(octet, C);
        kernels().add_stiffness(octet.batch, C, 1, pairs.of_batch(octet.index), sums);
      });
      pairs.add_sums(number++, kernels(), K);
    }
  }

  double element_share_;  // [-]; of the domains what is left of 1
  InstructionSet instruction_set_ = best_instruction_set();
  StencilBatches stencils_;
  std::vector<bool> of_elements_;  // one a batch
  StencilPairs pairs_, plain_pairs_;
};

}  // namespace articular::fem
