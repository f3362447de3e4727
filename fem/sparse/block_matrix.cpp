#include "fem/sparse/block_matrix.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <stdexcept>

namespace articular::fem {
namespace {

/// 64-bit FNV-1a, over words instead of bytes.
std::uint64_t hash(std::uint64_t seed, std::span<const int> words) {
  std::uint64_t h = seed;
  for (const int word : words) {
    h ^= static_cast<std::uint32_t>(word);
    h *= 0x100000001b3;  // the FNV prime
    h ^= h >> 32;        // whole words reach only upwards without this
  }
  return h;
}

}  // namespace

BlockMatrix::BlockMatrix(int num_blocks, std::span<const int> stencils,
                         std::span<const int> offsets) {
  assert(num_blocks >= 0);
  assert(std::all_of(stencils.begin(), stencils.end(),
                     [&](int i) { return i >= 0 && i < num_blocks; }));
  // The stencils that hold block i are stencil_of[begin[i] .. begin[i + 1]).
  std::vector<int> begin(static_cast<std::size_t>(num_blocks) + 1, 0);
  for (const int i : stencils) ++begin[i + 1];
  for (int i = 0; i < num_blocks; ++i) begin[i + 1] += begin[i];
  std::vector<int> stencil_of(stencils.size()), next(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k + 1 < offsets.size(); ++k) {
    for (int s = offsets[k]; s < offsets[k + 1]; ++s) {
      stencil_of[next[stencils[s]]++] = static_cast<int>(k);
    }
  }

  row_begin_.reserve(static_cast<std::size_t>(num_blocks) + 1);
  std::vector<int> last_row(static_cast<std::size_t>(num_blocks), -1);  // that holds block j
  for (int i = 0; i < num_blocks; ++i) {
    const std::size_t row_start = column_.size();
    last_row[i] = i;
    column_.push_back(i);
    for (int k = begin[i]; k < begin[i + 1]; ++k) {
      for (int s = offsets[stencil_of[k]]; s < offsets[stencil_of[k] + 1]; ++s) {
        const int j = stencils[s];
        if (last_row[j] == i) continue;
        last_row[j] = i;
        column_.push_back(j);
      }
    }
    if (column_.size() > std::numeric_limits<int>::max()) {
      throw std::length_error("a block matrix holds at most 2^31 - 1 blocks");
    }
    std::sort(column_.begin() + static_cast<std::ptrdiff_t>(row_start), column_.end());
    row_begin_.push_back(static_cast<int>(column_.size()));
  }
  values_.assign(9 * column_.size(), 0.0);
  pattern_id_ = hash(hash(0xcbf29ce484222325, row_begin_), column_);  // FNV's offset basis
}

int BlockMatrix::slot(int i, int j) const {
  assert(i >= 0 && i < num_blocks());
  // Without branches: which way the search goes can't be foretold.
  const int* found = column_.data() + row_begin_[i];
  for (int left = row_begin_[i + 1] - row_begin_[i]; left > 1;) {
    const int half = left / 2;
    found += found[half - 1] < j ? half : 0;
    left -= half;
  }
  return *found == j ? static_cast<int>(found - column_.data()) : -1;
}

void BlockMatrix::set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }

void BlockMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  assert(x.size() == 3 * Eigen::Index{num_blocks()});
  assert(&x != &y);
  y.resize(x.size());
  for (int i = 0; i < num_blocks(); ++i) {
    Vec3 sum = Vec3::Zero();
    for (int s = row_begin_[i]; s < row_begin_[i + 1]; ++s) {
      sum += block(s) * x.segment<3>(3 * Eigen::Index{column_[s]});
    }
    y.segment<3>(3 * Eigen::Index{i}) = sum;
  }
}

}  // namespace articular::fem
