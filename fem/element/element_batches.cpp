#include "fem/element/element_batches.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "fem/mesh/tetrahedron.hpp"

namespace articular::fem {
namespace {

std::size_t batch_of(int place) { return static_cast<std::size_t>(place / kBatchSize); }

// Smaller meshes are one part: threads would take longer to wake than to work.
constexpr int kSmallestToDivide = 8192;  // elements

Positions centers_of(const Positions& X, const Tetrahedra& tets) {
  Positions centers(3, tets.cols());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    centers.col(e) =
        0.25 * (X.col(tets(0, e)) + X.col(tets(1, e)) + X.col(tets(2, e)) + X.col(tets(3, e)));
  }
  return centers;
}

/// Halves the elements across the longest side of their box until `num_pieces` are left, about
/// equal and whole batches each, and calls visit(piece) for them in turn.
template <class Visit>
void bisect(std::span<int> elements, const Positions& centers, int num_pieces, Visit visit) {
  if (num_pieces <= 1 || elements.size() <= kBatchSize) return visit(elements);
  Vec3 low = centers.col(elements[0]), high = low;
  for (const int e : elements) {
    low = low.cwiseMin(centers.col(e));
    high = high.cwiseMax(centers.col(e));
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const int first_pieces = num_pieces / 2;
  const std::size_t share = elements.size() * static_cast<std::size_t>(first_pieces) /
                            static_cast<std::size_t>(num_pieces);
  const std::size_t middle = (share + kBatchSize - 1) / kBatchSize * kBatchSize;
  std::nth_element(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(middle),
                   elements.end(), [&](int e, int other) {
                     const double x = centers(axis, e), y = centers(axis, other);
                     return x != y ? x < y : e < other;
                   });
  bisect(elements.first(middle), centers, first_pieces, visit);
  bisect(elements.subspan(middle), centers, num_pieces - first_pieces, visit);
}

/// The elements of each inner part, then those of the border: elements whose nodes do not all have
/// the same owner. A node is owned by the first part that has an element at it.
std::vector<std::vector<int>> divide(const Tetrahedra& tets, const Positions& centers,
                                     Eigen::Index num_nodes, int num_parts) {
  std::vector<int> elements(static_cast<std::size_t>(tets.cols()));
  std::iota(elements.begin(), elements.end(), 0);
  std::vector<int> owner(static_cast<std::size_t>(num_nodes), -1);
  std::vector<std::vector<int>> parts;
  bisect(elements, centers, num_parts, [&](std::span<int> piece) {
    for (const int e : piece) {
      for (const int node : tets.col(e)) {
        int& of_node = owner[static_cast<std::size_t>(node)];
        if (of_node < 0) of_node = static_cast<int>(parts.size());
      }
    }
    parts.emplace_back(piece.begin(), piece.end());
  });
  std::vector<int> border;
  for (int part = 0; part < static_cast<int>(parts.size()); ++part) {
    std::erase_if(parts[static_cast<std::size_t>(part)], [&](int e) {
      const auto nodes = tets.col(e);
      const bool inside = std::all_of(nodes.begin(), nodes.end(), [&](int node) {
        return owner[static_cast<std::size_t>(node)] == part;
      });
      if (!inside) border.push_back(e);
      return !inside;
    });
  }
  parts.resize(ElementBatches::kInnerParts);
  parts.push_back(std::move(border));
  return parts;
}

}  // namespace

ElementBatches::ElementBatches(const Positions& X, const Tetrahedra& tets,
                               std::span<const double> volume) {
  const Positions centers = centers_of(X, tets);
  const int num_parts = tets.cols() < kSmallestToDivide ? 1 : kInnerParts;
  std::vector<std::vector<int>> parts = divide(tets, centers, X.cols(), num_parts);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    std::vector<int>& elements = parts[part];
    Part& result = part < kInnerParts ? inner_parts_[part] : border_;
    result.begin = num_chunks();
    const int pieces = (static_cast<int>(elements.size()) + kChunkSize - 1) / kChunkSize;
    bisect(elements, centers, pieces, [&](std::span<int> piece) {
      // Neighbours meet the same nodes: in the order of the nodes, where these have one.
      std::sort(piece.begin(), piece.end(), [&tets](int e, int other) {
        return std::pair(tets.col(e).minCoeff(), e) < std::pair(tets.col(other).minCoeff(), other);
      });
      append_chunk(piece, X, tets, volume);
    });
    result.end = num_chunks();
  }
  batches_.shrink_to_fit();
  element_.shrink_to_fit();
}

void ElementBatches::append_chunk(std::span<const int> elements, const Positions& X,
                                  const Tetrahedra& tets, std::span<const double> volume) {
  if (elements.empty()) return;
  const int begin = static_cast<int>(element_.size()), count = static_cast<int>(elements.size());
  assert(count <= kChunkSize);
  chunks_.push_back({begin, begin + count});
  element_.insert(element_.end(), elements.begin(), elements.end());
  while (element_.size() % kBatchSize != 0) element_.push_back(-1);
  batches_.resize(element_.size() / kBatchSize);
  for (int place = begin; place < static_cast<int>(element_.size()); ++place) {
    const int e = elements[static_cast<std::size_t>(std::min(place - begin, count - 1))];
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
