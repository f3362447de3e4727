#pragma once

#include <span>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/mesh/edge_domains.hpp"
#include "fem/simd/stencil_batch.hpp"

namespace articular::fem {

/// The domains of a mesh's edges and its tetrahedra in batches, batches in chunks. A chunk is a
/// compact piece of one material, found by bisection of the shape at rest, so that the blocks of
/// its pairs of nodes fit in the second-level cache; within it stencils of equal size are
/// neighbours. The order depends on the mesh only.
class StencilBatches {
 public:
  /// Batches [begin, elements) are domains, batches [elements, end) tetrahedra.
  struct Chunk {
    int material, begin, elements, end;
  };

  StencilBatches() = default;
  /// @param inverse_edges, volume, material_of_element  as for make_edge_domains()
  StencilBatches(const Positions& X, const Tetrahedra& tets, const EdgeDomains& domains,
                 std::span<const Mat3> inverse_edges, std::span<const double> volume,
                 std::span<const int> material_of_element);

  std::span<const Chunk> chunks() const { return chunks_; }
  int num_batches() const { return static_cast<int>(batches_.size()); }
  StencilBatch batch(int i) const;
  /// The domains, or the tetrahedra, of a batch; lanes beyond its count repeat the last one.
  const EightIndices& index(int i) const { return index_[static_cast<std::size_t>(i)]; }

 private:
  struct Batch {
    int num_nodes, count;
    std::size_t first_node;
  };
  struct Stencil;
  void append(std::span<const Stencil> stencils);

  std::vector<Chunk> chunks_;
  std::vector<Batch> batches_;
  std::vector<EightIndices> index_;  // one a batch
  std::vector<EightIndices> node_;
  std::vector<Eight> gradient_;  // 3 a node
  std::vector<Eight> volume_;    // one a batch
};

}  // namespace articular::fem
