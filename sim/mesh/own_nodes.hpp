#pragma once

#include <map>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::sim {

/// The nodes of some triangles, in the order in which they come up; triangles then refer to these.
inline std::vector<int> keep_own_nodes(Triangles& triangles) {
  std::vector<int> kept;
  std::map<int, int> number;
  for (int& node : triangles.reshaped()) {
    const auto [at, is_new] = number.emplace(node, static_cast<int>(kept.size()));
    if (is_new) kept.push_back(node);
    node = at->second;
  }
  return kept;
}

}  // namespace articular::sim
