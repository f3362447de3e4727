#pragma once

#include <span>
#include <vector>

#include "fem/element_batch.hpp"
#include "fem/types.hpp"

namespace articular::fem {

/// Places [begin, end) of elements; begin is that of a batch.
struct Chunk {
  int begin, end;
};

/// The tetrahedra of a mesh in batches: sorted by their lowest node, so that neighbours in the mesh
/// are neighbours in memory, each with its nodes in ascending order. (F = x-edges · X-edges⁻¹ does
/// not depend on the order of the nodes.)
class ElementBatches {
 public:
  /// @param volume  of each element, positive [m³]
  ElementBatches(const Positions& X, const Tetrahedra& tets, std::span<const double> volume);

  int num_chunks() const { return static_cast<int>(chunks_.size()); }
  const Chunk& chunk(int index) const { return chunks_[static_cast<std::size_t>(index)]; }
  std::span<const ElementBatch> batches() const { return batches_; }
  /// Index in the mesh of the element at a place: batch place / kBatchSize, lane place %
  /// kBatchSize.
  int element(int place) const { return element_[static_cast<std::size_t>(place)]; }
  Eigen::Vector4i nodes(int place) const;
  Mat3 inverse_edges(int place) const;
  double volume(int place) const;

 private:
  void append(std::span<const int> elements, const Positions& X, const Tetrahedra& tets,
              std::span<const double> volume);

  std::vector<ElementBatch> batches_;  // lanes behind the last element repeat it, without volume
  std::vector<int> element_;           // -1: nobody is there
  std::vector<Chunk> chunks_;
};

}  // namespace articular::fem
