#pragma once

#include <span>
#include <vector>

#include "fem/element_batch.hpp"
#include "fem/types.hpp"

namespace articular::fem {

/// The tetrahedra of a mesh in batches: sorted by their lowest node, so that neighbours in the mesh
/// are neighbours in memory, each with its nodes in ascending order. (F = x-edges · X-edges⁻¹ does
/// not depend on the order of the nodes.)
class ElementBatches {
 public:
  /// @param volume  of each element, positive [m³]
  ElementBatches(const Positions& X, const Tetrahedra& tets, std::span<const double> volume);

  int num_elements() const { return static_cast<int>(element_.size()); }
  std::span<const ElementBatch> batches() const { return batches_; }
  /// Index in the mesh of the element at a place: batch place / kBatchSize, lane place %
  /// kBatchSize.
  int element(int place) const { return element_[static_cast<std::size_t>(place)]; }
  Eigen::Vector4i nodes(int place) const;
  Mat3 inverse_edges(int place) const;
  double volume(int place) const;

 private:
  std::vector<ElementBatch> batches_;  // lanes behind the last element repeat it, without volume
  std::vector<int> element_;
};

}  // namespace articular::fem
