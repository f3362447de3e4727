#pragma once

#include "sim/mesh/mesh_io.hpp"

/// Meshes that no `geometry` of a scenario gives.
namespace articular::tools {

/// A box with a corner at the origin, whose inner nodes lie up to 0.15 of a cell beside the grid:
/// no element is like another. The same in every call.
sim::MeshData irregular_box(const Vec3& size, const Eigen::Vector3i& cells);

/// A cylinder along z, with its lower end around the origin. Its section is a polygon of 4
/// `cells_across` equal sides with the polar moment of area of the circle, π R⁴/2.
/// @param cells_across  even: so no element is flat
sim::MeshData cylinder(double radius, double length, int cells_across, int cells_along);

}  // namespace articular::tools
