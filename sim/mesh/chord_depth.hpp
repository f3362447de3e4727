#pragma once

#include "fem/base/types.hpp"
#include "sim/mesh/triangle_tree.hpp"

/// How deep something lies in what a closed surface bounds.
namespace articular::sim {

/// The distance from the surface [m] of a point inside; 0 outside.
/// @param X, tree  the surface's nodes [m], and the tree of its triangles
double depth_inside(const Positions& X, const Triangles& triangles, const TriangleTree& tree,
                    const Vec3& x);

/// Of the straight line from a to b: the deepest of 101 places [m], 0 where it stays outside.
double chord_depth(const Positions& X, const Triangles& triangles, const TriangleTree& tree,
                   const Vec3& a, const Vec3& b);

}  // namespace articular::sim
