#pragma once

#include "fem/base/types.hpp"

namespace articular::sim {

/// Mass, centre of mass and inertia about it.
struct MassProperties {
  double mass = 0;              // [kg]
  Vec3 center = Vec3::Zero();   // [m]
  Mat3 inertia = Mat3::Zero();  // [kg m²], about the centre
};

/// Of the solid that a closed surface bounds (outward normals), by the divergence theorem.
MassProperties solid_mass_properties(const Positions& X, const Triangles& surface, double density);

/// Of two bodies joined; used to add the mass of tissue nodes that a rigid body carries.
MassProperties join(const MassProperties& a, const MassProperties& b);

}  // namespace articular::sim
