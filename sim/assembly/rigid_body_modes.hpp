#pragma once

#include <optional>
#include <string>

#include "sim/assembly/dynamics.hpp"

namespace articular::sim {

/// A rigid motion of bodies that no force resists: equilibrium is singular along it.
struct RigidBodyMode {
  int body = 0;       // that takes part in it most
  std::string words;  // how it moves, for the user
};

/// "shift along (0.00 0.00 1.00)" or "turn about the axis (...) through (...) mm", whichever moves
/// it farther.
/// @param turn    rotation vector times the distance of what turns farthest [m]
/// @param center  what it turns about [m]
std::string rigid_motion_in_words(const Vec3& shift, const Vec3& turn, const Vec3& center);

/// Looks for one at the last Dynamics::evaluate(), among the rigid motions Z of all bodies (tissue
/// that is tied to a rigid body moves with it; what attachments hold, directly or through other
/// tissue, has none): in the null space of Zᵀ K Z, the motion that the forces drive, or any if
/// they drive none. Of bodies that the stiffness couples, more than a hundred with each other, none
/// is looked at.
std::optional<RigidBodyMode> find_rigid_body_mode(const Model& model, Dynamics& dynamics);

}  // namespace articular::sim
