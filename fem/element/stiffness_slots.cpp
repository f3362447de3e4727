#include "fem/element/stiffness_slots.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace articular::fem {
namespace {

constexpr int kRow[10] = {0, 1, 2, 3, 1, 2, 3, 2, 3, 3};
constexpr int kColumn[10] = {0, 0, 0, 0, 1, 1, 1, 2, 2, 3};

/// Two nodes of an element, and the place of that element.
struct Coupling {
  int high, low;     // nodes
  int lower, upper;  // slots of (high, low) and (low, high), -1: left out
  int place, k;      // pair k of the element
};

/// Diagonal pairs, then the other ones, both in the order of the matrix, then those left out.
auto order(const Coupling& c) {
  const int group = c.lower < 0 ? 2 : c.high == c.low ? 0 : 1;
  return std::tuple(group, std::max(c.lower, c.upper), c.high, c.low);
}

}  // namespace

StiffnessSlots::StiffnessSlots(const ElementBatches& elements, const BlockMatrix& A,
                               std::span<const int> block_of_node)
    : pairs_(elements.batches().size()), pattern_id_(A.pattern_id()) {
  for (const int block : block_of_node) {
    if (block < -1 || block >= A.num_blocks()) {
      std::ostringstream message;
      message << "a node has block row " << block << ", must be in [-1, " << A.num_blocks() << ')';
      throw std::invalid_argument(message.str());
    }
  }
  for (int chunk = 0; chunk < elements.num_chunks(); ++chunk) {
    append_chunk(elements, chunk, A, block_of_node);
  }
  slots_.shrink_to_fit();
}

void StiffnessSlots::append_chunk(const ElementBatches& elements, int chunk, const BlockMatrix& A,
                                  std::span<const int> block_of_node) {
  const auto slot = [&](int row_node, int column_node) {
    const int i = block_of_node[static_cast<std::size_t>(row_node)];
    const int j = block_of_node[static_cast<std::size_t>(column_node)];
    if (i < 0 || j < 0) return -1;
    const int result = A.slot(i, j);
    if (result >= 0) return result;
    std::ostringstream message;
    message << "the matrix has no block (" << i << ", " << j << "), which an element couples";
    throw std::invalid_argument(message.str());
  };
  std::vector<Coupling> couplings;
  const Chunk& range = elements.chunk(chunk);
  for (int place = range.begin; place < range.end; ++place) {
    const Eigen::Vector4i nodes = elements.nodes(place);
    for (int k = 0; k < 10; ++k) {
      const int high = nodes[kRow[k]], low = nodes[kColumn[k]];
      couplings.push_back({high, low, slot(high, low), slot(low, high), place, k});
    }
  }
  std::sort(couplings.begin(), couplings.end(),
            [](const Coupling& a, const Coupling& b) { return order(a) < order(b); });

  ChunkPairs result{range.begin / kBatchSize, slots_.size(), 0, 0, 0};
  const Coupling* last = nullptr;
  for (const Coupling& c : couplings) {
    if (last == nullptr || last->high != c.high || last->low != c.low) {
      ++result.num_pairs;
      if (c.lower >= 0) {
        ++result.num_coupled;
        result.num_diagonal += c.high == c.low;
        slots_.push_back({c.lower, c.upper});
      }
    }
    last = &c;
    pairs_[static_cast<std::size_t>(c.place / kBatchSize)].pair[c.k][c.place % kBatchSize] =
        static_cast<std::uint16_t>(result.num_pairs - 1);
  }
  chunks_.push_back(result);
}

void StiffnessSlots::describe(int chunk, ChunkJob& job) const {
  const ChunkPairs& pairs = chunks_[static_cast<std::size_t>(chunk)];
  job.pairs = pairs_.data() + pairs.first_batch;
  job.slots = slots_.data() + pairs.first_slots;
  job.num_diagonal = pairs.num_diagonal;
  job.num_coupled = pairs.num_coupled;
  job.num_pairs = pairs.num_pairs;
}

void StiffnessSlots::add(int chunk, int place, const Mat12& K_e, BlockMatrix& A) const {
  const ChunkPairs& chunk_pairs = chunks_[static_cast<std::size_t>(chunk)];
  const BatchPairs& batch = pairs_[static_cast<std::size_t>(place / kBatchSize)];
  for (int k = 0; k < 10; ++k) {
    const int pair = batch.pair[k][place % kBatchSize];
    if (pair >= chunk_pairs.num_coupled) continue;
    const PairSlots& slots = slots_[chunk_pairs.first_slots + static_cast<std::size_t>(pair)];
    const Mat3 K_ab = K_e.block<3, 3>(3 * kRow[k], 3 * kColumn[k]);
    A.block(slots.lower) += K_ab;
    if (slots.upper != slots.lower) A.block(slots.upper) += K_ab.transpose();
  }
}

}  // namespace articular::fem
