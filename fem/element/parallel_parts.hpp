#pragma once

#include <algorithm>
#include <array>
#include <thread>

#include "fem/element/element_batches.hpp"

namespace articular::fem {

/// Calls work(part, chunk) for all chunks: those of the inner parts on up to `threads` threads, and
/// then those of the border, whose part is kInnerParts. `work` does not throw.
template <class Work>
void for_each_chunk(const ElementBatches& elements, int threads, Work work) {
  constexpr int kParts = ElementBatches::kInnerParts;
  const auto run = [&work](int part, const Part& chunks) {
    for (int chunk = chunks.begin; chunk < chunks.end; ++chunk) work(part, chunk);
  };
  const auto run_inner = [&](int begin, int end) {
    for (int part = begin; part < end; ++part) {
      run(part, elements.inner_parts()[static_cast<std::size_t>(part)]);
    }
  };
  const bool divided = elements.inner_parts()[1].begin < elements.inner_parts()[1].end;
  const int num = divided ? std::clamp(threads, 1, kParts) : 1;
  {
    std::array<std::jthread, kParts> others;
    for (int t = 1; t < num; ++t) {
      others[static_cast<std::size_t>(t)] =
          std::jthread(run_inner, t * kParts / num, (t + 1) * kParts / num);
    }
    run_inner(0, kParts / num);
  }
  run(kParts, elements.border());
}

}  // namespace articular::fem
