#pragma once

#include "fem/simd/element_batch.hpp"

namespace articular::fem {

/// Eight stencils side by side: points whose deformation gradient is F = Σ_a x_a ⊗ ∂N_a/∂X with
/// Σ_a ∂N_a/∂X = 0, as the domains of edges and tetrahedra are. Those with fewer nodes than the
/// largest of the batch end with their own first node, with a gradient of zero.
struct StencilBatch {
  int num_nodes;
  int count;                 // stencils; lanes beyond do not exist
  const EightIndices* node;  // num_nodes, ascending but for those that fill up
  const Eight* gradient;     // 3 a node: ∂N_a/∂X [1/m]
  const Eight* volume;       // [m³]
};

}  // namespace articular::fem
