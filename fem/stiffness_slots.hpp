#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fem/block_matrix.hpp"
#include "fem/element_batches.hpp"

namespace articular::fem {

/// Where the stiffness of a mesh goes in a matrix, looked up once: element stiffnesses are added to
/// the lower half, in the order of the elements, and then the lower half is mirrored.
class StiffnessSlots {
 public:
  /// @param block_of_node  block row of each node, -1: the node is not among the unknowns, its rows
  ///                       and columns are left out. Different nodes have different rows.
  /// @throws std::invalid_argument where A has no block for two nodes of an element, or a row is
  ///         out of range
  StiffnessSlots(const ElementBatches& elements, const BlockMatrix& A,
                 std::span<const int> block_of_node);

  std::span<const BatchSlots> batches() const { return batches_; }
  std::uint64_t pattern_id() const { return pattern_id_; }
  /// Adds one element's stiffness, rows and columns 3a + i for its node a, to the lower half of A.
  void add(int place, const Mat12& K_e, BlockMatrix& A) const;
  /// Copies the blocks of the lower half, transposed, to the upper one: those of this mesh.
  void mirror(BlockMatrix& A) const;

 private:
  struct Pair {
    int lower, upper;
  };
  std::vector<BatchSlots> batches_;
  std::vector<Pair> pairs_;
  std::uint64_t pattern_id_ = 0;
};

}  // namespace articular::fem
