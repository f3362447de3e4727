#pragma once

#include "sim/mesh/mesh_io.hpp"
#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// The built-in geometries as tetrahedra, six a hexahedral cell, all positive.
MeshData box_mesh(const BoxGeometry& box);
MeshData hexahedron_mesh(const HexahedronGeometry& hexahedron);
MeshData sphere_mesh(const SphereGeometry& sphere);
MeshData v_shape_mesh(const VShapeGeometry& v);

/// x -> scale R (x - about) + about + translation, for every column.
void place(const Placement& placement, Positions& X);

}  // namespace articular::sim
