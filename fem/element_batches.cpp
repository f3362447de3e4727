#include "fem/element_batches.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "fem/tetrahedron.hpp"

namespace articular::fem {
namespace {

std::size_t batch_of(int place) { return static_cast<std::size_t>(place / kBatchSize); }

/// Halves elements across the longest side of their box until `num_parts` are left, which follow
/// each other and are about equal, each but the last a multiple of `granularity` long.
/// @return where parts end
void bisect(std::span<int> elements, const Positions& centers, int num_parts, int granularity,
            std::vector<std::size_t>& ends) {
  if (num_parts <= 1) {
    ends.push_back((ends.empty() ? 0 : ends.back()) + elements.size());
    return;
  }
  Vec3 low = centers.col(elements[0]), high = low;
  for (const int e : elements) {
    low = low.cwiseMin(centers.col(e));
    high = high.cwiseMax(centers.col(e));
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const int first_parts = num_parts / 2;
  const auto step = static_cast<std::size_t>(granularity);
  const std::size_t share =
      elements.size() * static_cast<std::size_t>(first_parts) / static_cast<std::size_t>(num_parts);
  const std::size_t middle = std::min((share + step - 1) / step * step, elements.size());
  std::nth_element(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(middle),
                   elements.end(), [&](int e, int other) {
                     const double x = centers(axis, e), y = centers(axis, other);
                     return x != y ? x < y : e < other;
                   });
  bisect(elements.first(middle), centers, first_parts, granularity, ends);
  bisect(elements.subspan(middle), centers, num_parts - first_parts, granularity, ends);
}

Positions centers_of(const Positions& X, const Tetrahedra& tets) {
  Positions centers(3, tets.cols());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    centers.col(e) =
        (X.col(tets(0, e)) + X.col(tets(1, e)) + X.col(tets(2, e)) + X.col(tets(3, e))) / 4;
  }
  return centers;
}

}  // namespace

ElementBatches::ElementBatches(const Positions& X, const Tetrahedra& tets,
                               std::span<const double> volume) {
  std::vector<int> elements(static_cast<std::size_t>(tets.cols()));
  std::iota(elements.begin(), elements.end(), 0);
  const Positions centers = centers_of(X, tets);
  const int num_chunks = (static_cast<int>(tets.cols()) + kChunkSize - 1) / kChunkSize;
  std::vector<std::size_t> ends;
  bisect(elements, centers, num_chunks, kBatchSize, ends);
  const auto lowest = [&tets](int e) { return tets.col(e).minCoeff(); };
  std::size_t begin = 0;
  const int mode = getenv("CH") ? atoi(getenv("CH")) : 0;
  for (const std::size_t end : ends) {
    std::span<int> c = std::span(elements).subspan(begin, end - begin);
    std::sort(c.begin(), c.end(),
              [&](int e, int o) { return std::pair(lowest(e), e) < std::pair(lowest(o), o); });
    if (mode == 1) {
      std::vector<int> sorted(c.begin(), c.end());
      const std::size_t C = c.size() / 8;
      for (std::size_t b = 0; b < C; ++b)
        for (std::size_t l = 0; l < 8; ++l) c[b * 8 + l] = sorted[l * C + b];
    }
    append(c, X, tets, volume);
    begin = end;
  }
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
