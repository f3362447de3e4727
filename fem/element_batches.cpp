#include "fem/element_batches.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "fem/tetrahedron.hpp"

namespace articular::fem {
namespace {

std::size_t batch_of(int place) { return static_cast<std::size_t>(place / kBatchSize); }

}  // namespace

ElementBatches::ElementBatches(const Positions& X, const Tetrahedra& tets,
                               std::span<const double> volume)
    : element_(static_cast<std::size_t>(tets.cols())) {
  std::iota(element_.begin(), element_.end(), 0);
  const auto lowest = [&tets](int e) { return tets.col(e).minCoeff(); };
  std::stable_sort(element_.begin(), element_.end(),
                   [&](int e, int other) { return lowest(e) < lowest(other); });

  const int num_batches = (num_elements() + kBatchSize - 1) / kBatchSize;
  batches_.resize(static_cast<std::size_t>(num_batches));
  for (int place = 0; place < num_batches * kBatchSize; ++place) {
    const int e = element(std::min(place, num_elements() - 1));
    ElementBatch& batch = batches_[batch_of(place)];
    const int lane = place % kBatchSize;
    Eigen::Vector4i nodes = tets.col(e);
    std::sort(nodes.begin(), nodes.end());
    Mat34 X_e;
    for (int a = 0; a < 4; ++a) {
      batch.node[a][lane] = nodes[a];
      X_e.col(a) = X.col(nodes[a]);
    }
    const Mat3 inverse = edge_matrix(X_e).inverse();
    for (int k = 0; k < 9; ++k) batch.inverse_edges[k][lane] = inverse.data()[k];
    batch.volume[lane] = place < num_elements() ? volume[static_cast<std::size_t>(e)] : 0;
  }
}

Eigen::Vector4i ElementBatches::nodes(int place) const {
  const ElementBatch& batch = batches_[batch_of(place)];
  const int lane = place % kBatchSize;
  return {batch.node[0][lane], batch.node[1][lane], batch.node[2][lane], batch.node[3][lane]};
}

Mat3 ElementBatches::inverse_edges(int place) const {
  Mat3 result;
  for (int k = 0; k < 9; ++k) {
    result.data()[k] = batches_[batch_of(place)].inverse_edges[k][place % kBatchSize];
  }
  return result;
}

double ElementBatches::volume(int place) const {
  return batches_[batch_of(place)].volume[place % kBatchSize];
}

}  // namespace articular::fem
