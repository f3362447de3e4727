#pragma once

#include <cstddef>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Calls work(t) for all tissues: for smoothed ones side by side, as their loops run on one thread;
/// then for the others, whose loops run on all. What work(t) writes must be the tissue's own.
template <class Work>
void for_each_tissue(const Model& model, const Work& work) {
  const auto is_smoothed = [&](std::size_t t) {
    return model.tissues[t].elements.smoothed() != nullptr;
  };
  model.pool->run(static_cast<int>(model.tissues.size()), [&](int k, int) {
    if (const auto t = static_cast<std::size_t>(k); is_smoothed(t)) work(t);
  });
  for (std::size_t t = 0; t < model.tissues.size(); ++t)
    if (!is_smoothed(t)) work(t);
}

}  // namespace articular::sim
