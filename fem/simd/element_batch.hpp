#pragma once

#include <cstdint>

namespace articular::fem {

/// Elements in a batch: as many doubles as the widest vector has. Narrower instruction sets take a
/// batch in several goes.
inline constexpr int kBatchSize = 8;

/// One number of each of eight elements.
struct alignas(64) Eight {
  double lane[kBatchSize];
};
struct EightIndices {
  int lane[kBatchSize];
};

/// Elements in a chunk, at most. Stiffnesses of a chunk are summed in a buffer of its own before
/// they go to the matrix: of 1000 neighbours, each block of the matrix has four on average, and the
/// buffer (200 kB) stays in the second-level cache.
inline constexpr int kChunkSize = 1024;

/// Eight tetrahedra side by side, so that one instruction works on all of them.
struct alignas(64) ElementBatch {
  double inverse_edges[9][kBatchSize];  // (X1-X0, X2-X0, X3-X0)⁻¹, column-major [1/m]
  double volume[kBatchSize];            // [m³]
  int node[4][kBatchSize];              // ascending
};

/// The ten pairs of nodes (a, b), a ≥ b, of each element as indices into those of its chunk, in the
/// order 00 10 20 30 11 21 31 22 32 33.
struct BatchPairs {
  std::uint16_t pair[10][kBatchSize];
};
static_assert(10 * kChunkSize <= 65536);

/// Places of the blocks (i, j) and (j, i) of a pair in a matrix; equal for a node with itself.
struct PairSlots {
  int lower, upper;
};

/// Sums of the 3x3 blocks of the pairs of nodes in a chunk, column-major: entries 0 to 7, and the
/// last one apart.
struct PairSums {
  Eight* entries;
  double* last;
};

/// What a kernel works on: one chunk. Lanes of its last batch from num_elements on do not exist.
struct ChunkJob {
  const ElementBatch* batches;
  int num_elements;
  double mu, lambda;  // of the law [Pa]
  const double* x;    // 3 a node [m]
  double* f;          // 3 a node: += ∂W/∂x [N]; force only
  // Stiffness only:
  const BatchPairs* pairs;
  const PairSlots* slots;  // of the first num_coupled pairs; the first num_diagonal are diagonal
  int num_diagonal, num_coupled, num_pairs;
  double scale;  // [-]
  double* K;     // 9 a block, column-major: += scale ∂²W/∂x² [N/m]
};

}  // namespace articular::fem
