#include "fem/element/moving_stencils.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>
#include <vector>

#include "fem/element/smoothed_elasticity.hpp"
#include "fem/mesh/rest_shape.hpp"

namespace articular::fem {
namespace {

/// One point an element.
StencilBatches stencils_of(const Positions& X, const Tetrahedra& tets) {
  std::vector<double> volume;
  std::vector<Mat3> inverse_edges;
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    volume.push_back(checked_volume(X, tets, e));
    inverse_edges.emplace_back(edge_matrix(gather(X, tets, e)).inverse());
  }
  EdgeDomains none;
  none.node_begin = {0};
  none.material_begin = {0, 0};
  return {X, tets, none, inverse_edges, volume, std::vector<int>(volume.size(), 0)};
}

}  // namespace

MovingStencils::MovingStencils(StencilBatches stencils, double element_share)
    : element_share_(element_share),
      stencils_(std::move(stencils)),
      of_elements_(static_cast<std::size_t>(stencils_.num_batches())) {
  for (const StencilBatches::Chunk& chunk : stencils_.chunks())
    std::fill(of_elements_.begin() + chunk.elements, of_elements_.begin() + chunk.end, true);
}

MovingStencils::MovingStencils(const Positions& X, const Tetrahedra& tets,
                               const BlockMatrix& matrix)
    : MovingStencils(stencils_of(X, tets), 1) {
  pairs_ = {stencils_, StencilPairs::Part::All, matrix};
}

MovingStencils::MovingStencils(const SmoothedElasticity& smoothed)
    : MovingStencils(smoothed.stencils(), smoothed.smoothing().plain_share) {
  assert(smoothed.domains().material_begin.size() == 2);
  pairs_ = {stencils_, StencilPairs::Part::All, smoothed.make_matrix()};
  plain_pairs_ = {stencils_, StencilPairs::Part::Elements, smoothed.make_plain_matrix()};
}

}  // namespace articular::fem
