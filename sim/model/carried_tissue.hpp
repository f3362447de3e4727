#pragma once

#include "sim/model/constrained_rigid_body.hpp"

/// Tissue nodes that are tied to a fixed body have mass, and go where its motion takes them. With
/// the reference point p, the masses' centre at c from it and V = (v, ω) of the body
///
///   momentum and kinetic energy   M V = (P, L_p),   T = ½ V·M V,   M by the nodes' lumped masses
///   force and moment about p      −d/dt (P, L_p) − (0, v × P) = −M V̇ − (m ω × (ω × c), ω × I_p ω)
///
/// on what drives the body, besides the forces on the nodes. The work of the drive against it is
/// the change of T. The nodes are not damped by mass, as those of a rigid body are not.
///
/// A smooth motion and a spline have accelerations V̇ everywhere. The velocity of a linear one jumps
/// at its times, where the force is infinite: it is the mean over a step, the change of momentum by
/// the step's length. So the sum of force times step is the change of momentum.
namespace articular::sim {

/// Whether it is a fixed body that is driven and carries tissue.
bool drives_tissue(const Model& model, const RigidBody& rigid);

/// T of what it carries [J].
double carried_kinetic_energy(const RigidBody& rigid, const Pose& pose,
                              const RigidVelocity& velocity);

/// That force [N] and moment about its reference point [N m].
/// @param step_start  of the step that ends at `at` [s]; not before it: no mean, no jump
Vec6 inertia_of_carried(const RigidBody& rigid, double step_start, Instant at);

}  // namespace articular::sim
