#include "fem/stiffness_slots.hpp"

#include <algorithm>
#include <cassert>
#include <sstream>
#include <stdexcept>

namespace articular::fem {
namespace {

constexpr int kRow[10] = {0, 1, 2, 3, 1, 2, 3, 2, 3, 3};
constexpr int kColumn[10] = {0, 0, 0, 0, 1, 1, 1, 2, 2, 3};

}  // namespace

StiffnessSlots::StiffnessSlots(const ElementBatches& elements, const BlockMatrix& A,
                               std::span<const int> block_of_node)
    : batches_(elements.batches().size()), pattern_id_(A.pattern_id()) {
  for (const int block : block_of_node) {
    if (block < -1 || block >= A.num_blocks()) {
      std::ostringstream message;
      message << "a node has block row " << block << ", must be in [-1, " << A.num_blocks() << ')';
      throw std::invalid_argument(message.str());
    }
  }
  std::vector<int> lower_slots;
  const auto slot = [&](int i, int j) {
    if (i < 0 || j < 0) return BatchSlots::kNone;
    const int lower = A.slot(std::max(i, j), std::min(i, j));
    if (lower < 0) {
      std::ostringstream message;
      message << "the matrix has no block (" << i << ", " << j << "), which an element couples";
      throw std::invalid_argument(message.str());
    }
    if (i != j) lower_slots.push_back(lower);
    return i >= j ? lower : BatchSlots::kTransposed - lower;
  };
  for (BatchSlots& batch : batches_) {
    for (auto& lanes : batch.slot) std::fill(lanes, lanes + kBatchSize, BatchSlots::kNone);
  }
  for (int place = 0; place < elements.num_elements(); ++place) {
    const Eigen::Vector4i nodes = elements.nodes(place);
    BatchSlots& batch = batches_[static_cast<std::size_t>(place / kBatchSize)];
    for (int k = 0; k < 10; ++k) {
      const auto block = [&](int a) { return block_of_node[static_cast<std::size_t>(nodes[a])]; };
      batch.slot[k][place % kBatchSize] = slot(block(kRow[k]), block(kColumn[k]));
    }
  }
  std::sort(lower_slots.begin(), lower_slots.end());
  lower_slots.erase(std::unique(lower_slots.begin(), lower_slots.end()), lower_slots.end());
  pairs_.reserve(lower_slots.size());
  int i = 0;
  for (const int lower : lower_slots) {
    while (A.row_begin()[static_cast<std::size_t>(i) + 1] <= lower) ++i;
    pairs_.push_back({lower, A.slot(A.column()[static_cast<std::size_t>(lower)], i)});
  }
}

void StiffnessSlots::add(int place, const Mat12& K_e, BlockMatrix& A) const {
  const BatchSlots& batch = batches_[static_cast<std::size_t>(place / kBatchSize)];
  for (int k = 0; k < 10; ++k) {
    const int slot = batch.slot[k][place % kBatchSize];
    const Mat3 K_ab = K_e.block<3, 3>(3 * kRow[k], 3 * kColumn[k]);
    if (slot >= 0) {
      A.block(slot) += K_ab;
    } else if (slot <= BatchSlots::kTransposed) {
      A.block(BatchSlots::kTransposed - slot) += K_ab.transpose();
    }
  }
}

void StiffnessSlots::mirror(BlockMatrix& A) const {
  assert(A.pattern_id() == pattern_id_);
  for (const Pair& pair : pairs_) {
    const double* const lower = A.block(pair.lower).data();
    double* const upper = A.block(pair.upper).data();
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) upper[3 * i + j] = lower[3 * j + i];
    }
  }
}

}  // namespace articular::fem
