#include "fem/element/stencil_batches.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "fem/mesh/tetrahedron.hpp"

namespace articular::fem {

/// One domain or tetrahedron.
struct StencilBatches::Stencil {
  int index;
  bool is_element;
  double volume;
  std::vector<int> node{};
  std::vector<Vec3> gradient{};
  Vec3 center = Vec3::Zero();
};

namespace {

// Pairs of nodes of the stencils in a chunk, at most. About a sixth of them are different; their
// blocks take 72 bytes each: 300 kB.
constexpr std::size_t kPairsOfChunk = 24000;

/// Halves the stencils across the longest side of their box until the pieces are small enough, and
/// calls visit(piece) for them in turn.
template <class Stencil, class Visit>
void bisect(std::span<Stencil> stencils, const Visit& visit) {
  std::size_t pairs = 0;
  for (const Stencil& s : stencils) pairs += s.node.size() * (s.node.size() + 1) / 2;
  if (pairs <= kPairsOfChunk || stencils.size() <= kBatchSize) return visit(stencils);
  Vec3 low = stencils[0].center, high = low;
  for (const Stencil& s : stencils) {
    low = low.cwiseMin(s.center);
    high = high.cwiseMax(s.center);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t middle = stencils.size() / 2;
  const auto key = [axis](const Stencil& s) {
    return std::tuple(s.center[axis], s.is_element, s.index);
  };
  std::nth_element(stencils.begin(), stencils.begin() + static_cast<std::ptrdiff_t>(middle),
                   stencils.end(),
                   [&](const Stencil& a, const Stencil& b) { return key(a) < key(b); });
  bisect(stencils.first(middle), visit);
  bisect(stencils.subspan(middle), visit);
}

}  // namespace

StencilBatches::StencilBatches(const Positions& X, const Tetrahedra& tets,
                               const EdgeDomains& domains, std::span<const Mat3> inverse_edges,
                               std::span<const double> volume,
                               std::span<const int> material_of_element) {
  const auto set_center = [&X](Stencil& s) {
    for (const int a : s.node) s.center += X.col(a) / static_cast<double>(s.node.size());
  };
  const int num_materials = static_cast<int>(domains.material_begin.size()) - 1;
  for (int m = 0; m < num_materials; ++m) {
    std::vector<Stencil> stencils;
    for (int k = domains.material_begin[m]; k < domains.material_begin[m + 1]; ++k) {
      const int begin = domains.node_begin[k], end = domains.node_begin[k + 1];
      Stencil s{.index = k, .is_element = false, .volume = domains.volume[k]};
      s.node.assign(domains.node.begin() + begin, domains.node.begin() + end);
      s.gradient.assign(domains.gradient.begin() + begin, domains.gradient.begin() + end);
      set_center(s);
      stencils.push_back(std::move(s));
    }
    for (int e = 0; e < static_cast<int>(tets.cols()); ++e) {
      if (material_of_element[e] != m) continue;
      const Mat34 dN_dX = shape_gradients(inverse_edges[e]);
      std::array<int, 4> corner{0, 1, 2, 3};
      std::sort(corner.begin(), corner.end(),
                [&](int a, int b) { return tets(a, e) < tets(b, e); });
      Stencil s{.index = e, .is_element = true, .volume = volume[e]};
      for (const int a : corner) {
        s.node.push_back(tets(a, e));
        s.gradient.emplace_back(dN_dX.col(a));
      }
      set_center(s);
      stencils.push_back(std::move(s));
    }
    bisect(std::span(stencils), [&](std::span<Stencil> piece) {
      const auto key = [](const Stencil& s) {
        return std::tuple(s.is_element, s.node.size(), s.node.front(), s.index);
      };
      std::sort(piece.begin(), piece.end(),
                [&](const Stencil& a, const Stencil& b) { return key(a) < key(b); });
      const auto first_element = static_cast<std::size_t>(
          std::find_if(piece.begin(), piece.end(), [](const Stencil& s) { return s.is_element; }) -
          piece.begin());
      Chunk chunk{.material = m, .begin = num_batches(), .elements = 0, .end = 0};
      append(piece.first(first_element));
      chunk.elements = num_batches();
      append(piece.subspan(first_element));
      chunk.end = num_batches();
      chunks_.push_back(chunk);
    });
  }
}

/// Batches of stencils in ascending order of their sizes.
void StencilBatches::append(std::span<const Stencil> stencils) {
  for (std::size_t first = 0; first < stencils.size(); first += kBatchSize) {
    const std::size_t count = std::min<std::size_t>(kBatchSize, stencils.size() - first);
    const std::size_t num_nodes = stencils[first + count - 1].node.size();
    const std::size_t first_node = node_.size();
    batches_.push_back({static_cast<int>(num_nodes), static_cast<int>(count), first_node});
    node_.resize(first_node + num_nodes);
    gradient_.resize(3 * node_.size());
    EightIndices& index = index_.emplace_back();
    Eight& volume = volume_.emplace_back();
    for (std::size_t lane = 0; lane < kBatchSize; ++lane) {
      const Stencil& s = stencils[first + std::min(lane, count - 1)];
      index.lane[lane] = s.index;
      volume.lane[lane] = s.volume;
      for (std::size_t a = 0; a < num_nodes; ++a) {
        const bool exists = a < s.node.size();
        node_[first_node + a].lane[lane] = exists ? s.node[a] : s.node[0];
        for (std::size_t i = 0; i < 3; ++i) {
          gradient_[3 * (first_node + a) + i].lane[lane] =
              exists ? s.gradient[a][static_cast<Eigen::Index>(i)] : 0;
        }
      }
    }
  }
}

StencilBatch StencilBatches::batch(int i) const {
  const auto b = static_cast<std::size_t>(i);
  const Batch& batch = batches_[b];
  return {batch.num_nodes, batch.count, &node_[batch.first_node], &gradient_[3 * batch.first_node],
          &volume_[b]};
}

}  // namespace articular::fem
