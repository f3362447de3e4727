#pragma once

#include "fem/element/element_batches.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// Calls work(part, chunk) for all chunks: those of the inner parts side by side, and then those of
/// the border, whose part is kInnerParts.
template <class Work>
void for_each_chunk(const ElementBatches& elements, ThreadPool& pool, const Work& work) {
  constexpr int kParts = ElementBatches::kInnerParts;
  const auto run = [&work](int part, const Part& chunks) {
    for (int chunk = chunks.begin; chunk < chunks.end; ++chunk) work(part, chunk);
  };
  const auto& inner = elements.inner_parts();
  const bool divided = inner[1].begin < inner[1].end;
  pool.run(divided ? kParts : 1,
           [&](int part, int) { run(part, inner[static_cast<std::size_t>(part)]); });
  run(kParts, elements.border());
}

}  // namespace articular::fem
