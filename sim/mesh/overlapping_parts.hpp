#pragma once

#include <optional>

#include "fem/base/types.hpp"
#include "sim/mesh/deepest_inside.hpp"

namespace articular::sim {

/// Of a mesh whose parts share no node: the deepest surface node of one part inside another; none
/// where no node is deeper than `least` [m].
/// @param X  nodes [m]
std::optional<DeepestPoint> deepest_in_another_part(const Positions& X, const Tetrahedra& tets,
                                                    double least);

}  // namespace articular::sim
