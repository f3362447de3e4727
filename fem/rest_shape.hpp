#pragma once

#include <string>

#include "fem/tetrahedron.hpp"
#include "fem/types.hpp"

namespace articular::fem {

/// The positions of the nodes of element e, one column a node.
inline Mat34 gather(const Positions& x, const Tetrahedra& tets, Eigen::Index e) {
  Mat34 x_e;
  for (int a = 0; a < 4; ++a) x_e.col(a) = x.col(tets(a, e));
  return x_e;
}

/// "tetrahedron 3 (nodes 0 1 2 4)", for messages.
std::string name_of(const Tetrahedra& tets, Eigen::Index e);

/// Volume of element e [m³].
/// @throws std::invalid_argument naming the element, unless its nodes are in range and its volume
/// is
///         positive and not flat
double checked_volume(const Positions& X, const Tetrahedra& tets, Eigen::Index e);

}  // namespace articular::fem
