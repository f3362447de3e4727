#pragma once

#include <string>

#include "sim/mesh/mesh_io.hpp"

namespace articular::sim {

/// Beyond it cubes of lengths, and so volumes, lose their meaning. [m]
constexpr double kLargestCoordinate = 1e18;

/// @throws InputError naming the file, the point (counted from 0) and its place
void refuse_far_positions(const std::string& file, const Positions& X);

/// Elements are counted from 0 in the order of the file.
/// @throws InputError naming the file and the elements where a tetrahedron has a node twice, or two
///         tetrahedra have the same four nodes: their faces would hide the surface
void refuse_repeated_elements(const std::string& file, const Tetrahedra& tets);

/// Nodes at exactly the position of another one: nothing holds the mesh together there.
struct CoincidentNodes {
  Eigen::Index count = 0;     // without the first of each place
  Vec3 place = Vec3::Zero();  // of one of them [m]
};
CoincidentNodes coincident_nodes(const Positions& X);

}  // namespace articular::sim
