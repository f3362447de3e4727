#pragma once

#include <string>

#include "fem/base/types.hpp"
#include "fem/mesh/tetrahedron.hpp"

namespace articular::fem {

/// The positions of four nodes, one column a node.
inline Mat34 gather(const Positions& x, const Eigen::Vector4i& nodes) {
  Mat34 x_e;
  for (int a = 0; a < 4; ++a) x_e.col(a) = x.col(nodes[a]);
  return x_e;
}
/// Those of element e.
inline Mat34 gather(const Positions& x, const Tetrahedra& tets, Eigen::Index e) {
  return gather(x, tets.col(e));
}

/// "tetrahedron 3 (nodes 0 1 2 4)", for messages.
std::string name_of(const Tetrahedra& tets, Eigen::Index e);

/// Volume of element e [m³].
/// @throws std::invalid_argument naming the element, unless its nodes are in range and its volume
/// is
///         positive and not flat
double checked_volume(const Positions& X, const Tetrahedra& tets, Eigen::Index e);

}  // namespace articular::fem
