#pragma once

#include <utility>

#include "sim/assembly/moment.hpp"

/// Forces that bodies put on what holds them.
namespace articular::sim {

/// Force [N] and moment [N m], about its reference point, that a fixed, driven or held body puts on
/// what holds it. The inertia of tissue that it carries is in it: see carried_tissue.hpp.
Vec6 reaction_of(const Moment& now, int rigid);
/// The same with the accelerations that a step from there begins with.
Vec6 reaction_as_step_begins(const Moment& now, int rigid);

/// Force [N] that tissue puts on a support, and its moment [N m] about the support's centre. The
/// inertia of nodes that are driven is in it: see driven_supports.hpp.
std::pair<Vec3, Vec3> force_on_support(const Moment& now, const SupportModel& support);

/// That force without the inertia.
Vec3 held_force_on_support(const Moment& now, const SupportModel& support);

/// Force [N] on a rigid body of the tissue that is tied to it, and its moment [N m] about the
/// body's reference point: elasticity, with its dampers, and what contact puts on the tied nodes.
std::pair<Vec3, Vec3> attachment_force(const Moment& now, int tissue, int rigid);

}  // namespace articular::sim
