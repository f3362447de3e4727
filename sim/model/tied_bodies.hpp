#pragma once

#include <algorithm>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Whether a node of the tissue goes with this rigid body, an index into Model::rigid_bodies.
inline bool is_tied_to(const Tissue& tissue, int rigid) {
  return std::ranges::any_of(tissue.nodes,
                             [&](const NodeRef& node) { return node.rigid == rigid; });
}

/// Whether a line has a point that goes with this rigid body, or wraps around it.
inline bool pulls_on(const Model& model, const Line& line, int rigid) {
  const auto goes_with = [&](const NodeRef& node) { return node.rigid == rigid; };
  return std::ranges::any_of(line.path,
                             [&](const WeightedPoint& point) {
                               return std::ranges::any_of(point.nodes, goes_with);
                             }) ||
         std::ranges::any_of(line.wrap.bodies, [&](int wrapped) {
           return model.wrap_bodies[static_cast<std::size_t>(wrapped)].rigid == rigid;
         });
}

/// Whether tissue of one body is tied to the other: then it belongs there.
inline bool are_tied(const Model& model, int a, int b) {
  const auto belongs_to = [&](int tissue, int rigid) {
    const BodyModel &body = model.bodies[static_cast<std::size_t>(tissue)],
                    &other = model.bodies[static_cast<std::size_t>(rigid)];
    return body.tissue >= 0 && other.rigid >= 0 &&
           is_tied_to(model.tissues[static_cast<std::size_t>(body.tissue)], other.rigid);
  };
  return belongs_to(a, b) || belongs_to(b, a);
}

}  // namespace articular::sim
