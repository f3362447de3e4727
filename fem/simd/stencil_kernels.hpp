#pragma once

#include "fem/simd/element_kernels.hpp"
#include "fem/simd/stencil_batch.hpp"

namespace articular::fem {

/// Loops over eight stencils that do not depend on the law. x, f: 3 a node. F, P and C
/// as in point_kernels.hpp. What is added is added in the order of the stencils.
struct StencilKernels {
  /// F = Σ x_a ⊗ ∂N_a/∂X
  void (*deformation_gradient)(const StencilBatch&, const double* x, Eight* F);
  /// f_a += V P ∂N_a/∂X
  void (*add_force)(const StencilBatch&, const Eight* P, double* f);
  /// K_ab += scale V ∂N_a/∂X · C · ∂N_b/∂X for all a ≥ b.
  /// @param pair  of (a, b), in the order 00 10 20 ... 11 21 ...
  void (*add_stiffness)(const StencilBatch&, const Eight* C, double scale, const EightIndices* pair,
                        const PairSums&);
  /// Of tetrahedra: G_ac += V/4 P ∂N_a/∂X for all four pressures c. G: 3 a slot.
  /// @param slot  of (a, c), 4 a + c
  void (*add_pressure_gradient)(const StencilBatch&, const Eight* P, const EightIndices* slot,
                                double* G);
  /// Bit k: C of point k is not positive semidefinite up to round-off, or not a number.
  unsigned (*indefinite)(const Eight* C);
  void (*set_zero)(int num_pairs, const PairSums&);
  /// To both halves of a matrix K with 9 values a block. The first num_diagonal pairs are diagonal.
  void (*add_to_matrix)(const PairSums&, const PairSlots*, int num_diagonal, int num_pairs,
                        double* K);
};

/// @param set  one that the machine has
const StencilKernels& stencil_kernels(InstructionSet set);

namespace baseline {
extern const StencilKernels stencil_kernels;
}
namespace avx2 {
extern const StencilKernels stencil_kernels;
}
namespace avx512 {
extern const StencilKernels stencil_kernels;
}

}  // namespace articular::fem
