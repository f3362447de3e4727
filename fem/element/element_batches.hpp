#pragma once

#include <array>
#include <span>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/simd/element_batch.hpp"

namespace articular::fem {

/// Places [begin, end) of elements; begin is that of a batch.
struct Chunk {
  int begin, end;
};

/// Chunks [begin, end).
struct Part {
  int begin, end;
};

/// The tetrahedra of a mesh in batches, batches in chunks, chunks in parts. Chunks are compact
/// pieces of the mesh, found by bisection of its shape at rest, whatever the numbers of its nodes.
/// The nodes of an element are in ascending order: F = x-edges · X-edges⁻¹ does not depend on it.
///
/// No node belongs to two of the inner parts, so that these may be worked on at the same time; the
/// border has the elements in between, and comes after them. Parts do not depend on the number of
/// threads, so sums do not either.
class ElementBatches {
 public:
  static constexpr int kInnerParts = 4;  // of a mesh that is large enough; threads beyond are idle

  /// @param volume  of each element, positive [m³]
  ElementBatches(const Positions& X, const Tetrahedra& tets, std::span<const double> volume);

  int num_chunks() const { return static_cast<int>(chunks_.size()); }
  const Chunk& chunk(int index) const { return chunks_[static_cast<std::size_t>(index)]; }
  const std::array<Part, kInnerParts>& inner_parts() const { return inner_parts_; }
  const Part& border() const { return border_; }
  std::span<const ElementBatch> batches() const { return batches_; }
  /// Index in the mesh of the element at a place: batch place / kBatchSize, lane place %
  /// kBatchSize.
  int element(int place) const { return element_[static_cast<std::size_t>(place)]; }
  Eigen::Vector4i nodes(int place) const;
  Mat3 inverse_edges(int place) const;
  double volume(int place) const;

 private:
  void append_chunk(std::span<const int> elements, const Positions& X, const Tetrahedra& tets,
                    std::span<const double> volume);

  std::vector<ElementBatch> batches_;  // lanes behind the last element repeat it, without volume
  std::vector<int> element_;           // -1: nobody is there
  std::vector<Chunk> chunks_;
  std::array<Part, kInnerParts> inner_parts_{};
  Part border_{};
};

}  // namespace articular::fem
