#include "fem/element/stencil_pairs.hpp"

#include <algorithm>
#include <cassert>

namespace articular::fem {
namespace {

/// Calls visit(a, b, lane) for the pairs a ≥ b of a batch in the order of the kernels.
template <class Visit>
void for_each_pair(const StencilBatch& batch, Visit visit) {
  for (int b = 0; b < batch.num_nodes; ++b) {
    for (int a = b; a < batch.num_nodes; ++a) {
      for (int lane = 0; lane < kBatchSize; ++lane) visit(a, b, lane);
    }
  }
}

/// Nodes that fill up a batch repeat the first one.
bool exists(const StencilBatch& batch, int a, int lane) {
  return a == 0 || batch.node[a].lane[lane] != batch.node[0].lane[lane];
}

}  // namespace

StencilPairs::StencilPairs(const StencilBatches& stencils, Part part, const BlockMatrix& K)
    : part_(part),
      pattern_id_(K.pattern_id()),
      first_pair_(static_cast<std::size_t>(stencils.num_batches()), 0) {
  std::vector<int> pair_of_slot(static_cast<std::size_t>(K.num_nonzero_blocks()), -1);
  int most_pairs = 0;
  for (const StencilBatches::Chunk& chunk : stencils.chunks()) {
    append_chunk(stencils, chunk, K, pair_of_slot);
    most_pairs = std::max(most_pairs, chunks_.back().num_pairs);
  }
  entries_.resize(static_cast<std::size_t>(most_pairs) + 1);
  last_.resize(entries_.size());
}

/// @param pair_of_slot  work: −1 for each block of K, before and after
void StencilPairs::append_chunk(const StencilBatches& stencils, const StencilBatches::Chunk& chunk,
                                const BlockMatrix& K, std::vector<int>& pair_of_slot) {
  const std::size_t first_slot = slots_.size();
  // The blocks below the diagonal, each once, by their slots.
  std::vector<int> lower;  // of each pair, −1 for those that do not exist
  for (int i = first_batch(chunk); i < chunk.end; ++i) {
    const StencilBatch batch = stencils.batch(i);
    for_each_pair(batch, [&](int a, int b, int lane) {
      if (!exists(batch, a, lane) || !exists(batch, b, lane)) return lower.push_back(-1);
      const int high = batch.node[a].lane[lane], low = batch.node[b].lane[lane];
      const int slot = K.slot(high, low);
      assert(slot >= 0);
      lower.push_back(slot);
      int& pair = pair_of_slot[static_cast<std::size_t>(slot)];
      if (pair < 0) slots_.push_back({slot, K.slot(low, high)});
      pair = 0;
    });
  }
  std::sort(slots_.begin() + static_cast<std::ptrdiff_t>(first_slot), slots_.end(),
            [](const PairSlots& p, const PairSlots& q) {
              const bool p_beside = p.lower != p.upper, q_beside = q.lower != q.upper;
              return p_beside != q_beside ? q_beside : p.lower < q.lower;
            });
  ChunkPairs result{first_slot, 0, static_cast<int>(slots_.size() - first_slot)};
  for (int pair = 0; pair < result.num_pairs; ++pair) {
    const PairSlots& slots = slots_[first_slot + static_cast<std::size_t>(pair)];
    result.num_diagonal += slots.lower == slots.upper;
    pair_of_slot[static_cast<std::size_t>(slots.lower)] = pair;
  }
  const int* slot = lower.data();
  for (int i = first_batch(chunk); i < chunk.end; ++i) {
    first_pair_[static_cast<std::size_t>(i)] = pairs_.size();
    for_each_pair(stencils.batch(i), [&](int, int, int lane) {
      if (lane == 0) pairs_.emplace_back();
      pairs_.back().lane[lane] =
          *slot < 0 ? result.num_pairs : pair_of_slot[static_cast<std::size_t>(*slot)];
      ++slot;
    });
  }
  for (std::size_t k = first_slot; k < slots_.size(); ++k) {
    pair_of_slot[static_cast<std::size_t>(slots_[k].lower)] = -1;
  }
  chunks_.push_back(result);
}

PairSums StencilPairs::zero_sums(int chunk, const StencilKernels& kernels) const {
  const PairSums sums{entries_.data(), last_.data()};
  kernels.set_zero(chunks_[static_cast<std::size_t>(chunk)].num_pairs + 1, sums);
  return sums;
}

void StencilPairs::add_sums(int chunk, const StencilKernels& kernels, BlockMatrix& K) const {
  const ChunkPairs& pairs = chunks_[static_cast<std::size_t>(chunk)];
  kernels.add_to_matrix({entries_.data(), last_.data()}, slots_.data() + pairs.first_slot,
                        pairs.num_diagonal, pairs.num_pairs, K.values());
}

}  // namespace articular::fem
