#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::fem {

/// The lowest node of the part of the mesh that each node is connected to.
inline std::vector<int> parts_of_nodes(int num_nodes, const Tetrahedra& tets) {
  std::vector<int> part(static_cast<std::size_t>(num_nodes));
  std::iota(part.begin(), part.end(), 0);
  const auto next = [&part](int a) -> int& { return part[static_cast<std::size_t>(a)]; };
  const auto root = [&next](int a) {
    while (next(a) != a) a = next(a) = next(next(a));
    return a;
  };
  for (const auto& tet : tets.colwise()) {
    for (int a = 1; a < 4; ++a) {
      const int p = root(tet[0]), q = root(tet[a]);
      next(std::max(p, q)) = std::min(p, q);
    }
  }
  for (int a = 0; a < num_nodes; ++a) next(a) = root(a);
  return part;
}

}  // namespace articular::fem
