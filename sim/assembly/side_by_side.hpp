#pragma once

#include <algorithm>
#include <cstddef>

#include "sim/model/model.hpp"

namespace articular::sim {

inline bool is_smoothed(const Tissue& tissue) { return tissue.elements.smoothed() != nullptr; }

/// Calls work(t) for smoothed tissues, side by side: their loops run on one thread. What work(t)
/// writes must be the tissue's own. Threads are not woken where there are none.
template <class Work>
void for_each_smoothed(const Model& model, const Work& work) {
  if (std::none_of(model.tissues.begin(), model.tissues.end(), is_smoothed)) return;
  model.pool->run(static_cast<int>(model.tissues.size()), [&](int k, int) {
    if (const auto t = static_cast<std::size_t>(k); is_smoothed(model.tissues[t])) work(t);
  });
}

/// The same, with other() beside them, which begins first. It runs on one thread as well.
template <class Work, class Other>
void for_each_smoothed_beside(const Model& model, const Work& work, const Other& other) {
  if (std::none_of(model.tissues.begin(), model.tissues.end(), is_smoothed)) return other();
  model.pool->run(static_cast<int>(model.tissues.size()) + 1, [&](int k, int) {
    if (k == 0) return other();
    if (const auto t = static_cast<std::size_t>(k - 1); is_smoothed(model.tissues[t])) work(t);
  });
}

/// Calls work(t) for the others, one after the other: their loops run on all threads.
template <class Work>
void for_each_plain(const Model& model, const Work& work) {
  for (std::size_t t = 0; t < model.tissues.size(); ++t)
    if (!is_smoothed(model.tissues[t])) work(t);
}

/// Both.
template <class Work>
void for_each_tissue(const Model& model, const Work& work) {
  for_each_smoothed(model, work);
  for_each_plain(model, work);
}

}  // namespace articular::sim
