#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fem/element/element_batches.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

/// Where the stiffness of a mesh goes in a matrix, looked up once. Each chunk of elements sums its
/// own blocks first, one for each pair of nodes that an element couples.
class StiffnessSlots {
 public:
  /// @param block_of_node  block row of each node, -1: the node is not among the unknowns, its rows
  ///                       and columns are left out. Different nodes have different rows.
  /// @throws std::invalid_argument where A has no block for two nodes of an element, or a row is
  ///         out of range
  StiffnessSlots(const ElementBatches& elements, const BlockMatrix& A,
                 std::span<const int> block_of_node);

  std::uint64_t pattern_id() const { return pattern_id_; }
  /// Fills in what a kernel has to know about the pairs of a chunk.
  void describe(int chunk, ChunkJob& job) const;
  /// Adds one element's stiffness, rows and columns 3a + i for its node a, to A.
  void add(int chunk, int place, const Mat12& K_e, BlockMatrix& A) const;

 private:
  struct ChunkPairs {
    int first_batch;
    std::size_t first_slots;
    int num_diagonal, num_coupled, num_pairs;
  };
  void append_chunk(const ElementBatches& elements, int chunk, const BlockMatrix& A,
                    std::span<const int> block_of_node);

  std::vector<ChunkPairs> chunks_;
  std::vector<BatchPairs> pairs_;
  std::vector<PairSlots> slots_;
  std::uint64_t pattern_id_ = 0;
};

}  // namespace articular::fem
