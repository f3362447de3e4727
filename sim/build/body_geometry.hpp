#pragma once

#include <string>
#include <utility>

#include "sim/mesh/mesh_io.hpp"
#include "sim/model/mass_properties.hpp"
#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// What was read of one body.
struct BodyGeometry {
  MeshData mesh;     // drawn; tissue: with tetrahedra
  MeshData contact;  // surfaces that touch, without tetrahedra; empty: the mesh
};

/// Reads or builds a body's meshes, placed. @throws InputError with the place in the scenario
BodyGeometry read_geometry(const Body& body);

/// Mass, centre and inertia of a rigid body: as given, else those of the solid within its surface.
/// @throws InputError when the surface encloses nothing
MassProperties rigid_mass(const Body& body, const MeshData& mesh);

/// Whether a point lies in the box between a lower and an upper corner.
bool lies_in(const std::pair<Vec3, Vec3>& box, const Vec3& x);

/// " (FILE)" of a body that comes from a file, for messages.
std::string mesh_name(const Body& body);

/// Where the scenario names that file, or else the body, for messages.
const Location& mesh_place(const Body& body);

}  // namespace articular::sim
