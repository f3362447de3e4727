#pragma once

#include <algorithm>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Whether tissue of one body is tied to the other: then it belongs there.
inline bool are_tied(const Model& model, int a, int b) {
  const auto is_tied_to = [&](int tissue, int rigid) {
    const BodyModel &body = model.bodies[static_cast<std::size_t>(tissue)],
                    &other = model.bodies[static_cast<std::size_t>(rigid)];
    if (body.tissue < 0 || other.rigid < 0) return false;
    return std::ranges::any_of(model.tissues[static_cast<std::size_t>(body.tissue)].nodes,
                               [&](const NodeRef& node) { return node.rigid == other.rigid; });
  };
  return is_tied_to(a, b) || is_tied_to(b, a);
}

}  // namespace articular::sim
