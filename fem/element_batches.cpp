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
                               std::span<const double> volume) {
  std::vector<int> order(static_cast<std::size_t>(tets.cols()));
  std::iota(order.begin(), order.end(), 0);
  const auto lowest = [&tets](int e) { return tets.col(e).minCoeff(); };
  std::stable_sort(order.begin(), order.end(),
                   [&](int e, int other) { return lowest(e) < lowest(other); });
  append(order, X, tets, volume);
}

/// Appends elements in chunks of their own.
void ElementBatches::append(std::span<const int> elements, const Positions& X,
                            const Tetrahedra& tets, std::span<const double> volume) {
  const int first = static_cast<int>(element_.size()), count = static_cast<int>(elements.size());
  for (int begin = 0; begin < count; begin += kChunkSize) {
    chunks_.push_back({first + begin, first + std::min(begin + kChunkSize, count)});
  }
  element_.insert(element_.end(), elements.begin(), elements.end());
  while (element_.size() % kBatchSize != 0) element_.push_back(-1);
  batches_.resize(element_.size() / kBatchSize);
  for (int place = first; place < static_cast<int>(element_.size()); ++place) {
    const int e = elements[static_cast<std::size_t>(std::min(place - first, count - 1))];
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
    batch.volume[lane] = element(place) >= 0 ? volume[static_cast<std::size_t>(e)] : 0;
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
