#pragma once

#include "sim/mesh/mesh_io.hpp"

namespace articular::sim {

/// Tetrahedra whose least height is below a fiftieth of their longest edge. Where they bridge
/// valleys of a surface they resist being pressed flat as if they were rigid: contact bears on
/// their high nodes alone (the pressure there is too large by half, the force on the whole right).
struct FlatElements {
  Eigen::Index count = 0;
  Vec3 flattest = Vec3::Zero();  // middle of the flattest [m]
};
FlatElements flat_elements(const Positions& X, const Tetrahedra& tets);

}  // namespace articular::sim
