#pragma once

#include <algorithm>
#include <cstddef>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Calls work(t) for smoothed tissues, side by side: their loops run on one thread. What work(t)
/// writes must be the tissue's own. Threads are not woken where there are none.
template <class Work>
void for_each_smoothed(const Model& model, const Work& work) {
  const auto is_smoothed = [](const Tissue& tissue) {
    return tissue.elements.smoothed() != nullptr;
  };
  if (std::none_of(model.tissues.begin(), model.tissues.end(), is_smoothed)) return;
  model.pool->run(static_cast<int>(model.tissues.size()), [&](int k, int) {
    if (const auto t = static_cast<std::size_t>(k); is_smoothed(model.tissues[t])) work(t);
  });
}

/// The same for all tissues: then for the others, whose loops run on all threads.
template <class Work>
void for_each_tissue(const Model& model, const Work& work) {
  for_each_smoothed(model, work);
  for (std::size_t t = 0; t < model.tissues.size(); ++t)
    if (model.tissues[t].elements.smoothed() == nullptr) work(t);
}

}  // namespace articular::sim
