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

/// Looks for one at the last Dynamics::evaluate(), among the rigid motions Z of all bodies (tissue
/// that is tied to a rigid body moves with it; what attachments hold, directly or through other
/// tissue, has none): in the null space of Zᵀ K Z, the motion that the forces drive, or any if
/// they drive none.
std::optional<RigidBodyMode> find_rigid_body_mode(const Model& model, Dynamics& dynamics);

}  // namespace articular::sim
