#pragma once

#include <cstdint>
#include <vector>

#include "fem/element/stencil_batches.hpp"
#include "fem/simd/stencil_kernels.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

/// Where the stiffness of stencils goes in a matrix, looked up once. Each chunk sums its own blocks
/// first, one for each pair of nodes in a stencil. Holds the memory for that.
class StencilPairs {
 public:
  /// Which batches of a chunk.
  enum class Part { All, Elements };

  StencilPairs() = default;
  /// @param K  one block row a node, with a block for each pair
  StencilPairs(const StencilBatches& stencils, Part part, const BlockMatrix& K);

  std::uint64_t pattern_id() const { return pattern_id_; }
  /// Of a batch: see StencilKernels::add_stiffness.
  const EightIndices* of_batch(int i) const {
    return pairs_.data() + first_pair_[static_cast<std::size_t>(i)];
  }
  /// Sums of zero for the pairs of a chunk. The next chunk has the same memory.
  PairSums zero_sums(int chunk, const StencilKernels& kernels) const;
  /// K += the sums
  void add_sums(int chunk, const StencilKernels& kernels, BlockMatrix& K) const;

 private:
  struct ChunkPairs {
    std::size_t first_slot;
    int num_diagonal, num_pairs;
  };
  /// The first batch of a chunk that has pairs here.
  int first_batch(const StencilBatches::Chunk& chunk) const {
    return part_ == Part::All ? chunk.begin : chunk.elements;
  }
  void append_chunk(const StencilBatches& stencils, const StencilBatches::Chunk& chunk,
                    const BlockMatrix& K, std::vector<int>& pair_of_slot);

  Part part_ = Part::All;
  std::uint64_t pattern_id_ = 0;
  std::vector<ChunkPairs> chunks_;
  std::vector<PairSlots> slots_;
  std::vector<EightIndices> pairs_;      // of all batches
  std::vector<std::size_t> first_pair_;  // of each batch
  // One more than a chunk has pairs: nodes that fill up a batch meet there.
  mutable std::vector<Eight> entries_;
  mutable std::vector<double> last_;
};

}  // namespace articular::fem
