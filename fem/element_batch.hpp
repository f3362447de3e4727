#pragma once

#include <cstddef>

namespace articular::fem {

/// Elements in a batch: as many doubles as the widest vector has. Narrower instruction sets take a
/// batch in several goes.
inline constexpr int kBatchSize = 8;

/// Eight tetrahedra side by side, so that one instruction works on all of them.
struct alignas(64) ElementBatch {
  double inverse_edges[9][kBatchSize];  // (X1-X0, X2-X0, X3-X0)⁻¹, column-major [1/m]
  double volume[kBatchSize];            // [m³]
  int node[4][kBatchSize];
};

/// Where the stiffness of a batch goes: places of the ten blocks (a, b), a ≥ b, in the values of a
/// matrix, in the order 00 10 20 30 11 21 31 22 32 33.
struct BatchSlots {
  static constexpr int kNone = -1;  // a node is not among the unknowns
  // Below: block (a, b) lies above the diagonal, so its transpose goes to slot kTransposed − entry.
  static constexpr int kTransposed = -2;
  int slot[10][kBatchSize];
};

/// What a kernel works on. Elements of the last batch from num_elements on do not exist.
struct BatchJob {
  const ElementBatch* batches;
  const BatchSlots* slots;  // of the same batches; stiffness only
  int num_elements;
  double mu, lambda;  // of the law [Pa]
  const double* x;    // 3 a node [m]
  double* f;          // 3 a node: += ∂W/∂x [N]; force only
  double scale;       // of the stiffness [-]
  double* K;          // 9 a block, column-major: += scale ∂²W/∂x² [N/m]; stiffness only
};

}  // namespace articular::fem
