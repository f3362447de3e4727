#pragma once

#include "sim/model/model.hpp"

namespace articular::sim {

/// A shell of tetrahedra under a surface: each triangle sinks along the vertex normals into a prism
/// of three tetrahedra. Where the surface bends so sharply that prisms would fold, the shell is
/// thinner; triangles over which no shell is left (slivers, creases) are dropped from `triangles`.
/// Nodes 0 .. n-1 are the surface's, n .. 2n-1 those below them.
Tetrahedra shell_under(Positions& X, Triangles& triangles, double thickness);

/// Faces and areas, nearby faces and sizes of a collider whose X, tets and nodes are set.
/// @param is_outer  per node: on the surface that a shell lies under, the only one that touches;
/// empty =
///                  every face touches
void complete_collider(Collider& collider, const std::vector<char>& is_outer);

/// Of a compact body or a plate [m]: of a curved plate, three times that at most.
double half_thickness(const Collider& collider);

}  // namespace articular::sim
