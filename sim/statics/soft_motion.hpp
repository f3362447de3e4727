#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/statics/equilibrium.hpp"

namespace articular::sim {

/// A body's part of a motion.
struct BodyMotion {
  int body = 0;
  double distance = 0;  // of its farthest point, where that of the whole motion is 1 [-]
  std::string words;    // "shift along (0.00 0.00 1.00)"
};

/// A motion that meets next to no resistance: a small force along it carries bodies far.
struct SoftMotion {
  Eigen::VectorXd blocks;          // of the unknown blocks; what moves farthest moves by 1
  double stiffness = 0;            // force along it by the way of what moves farthest [N/m]
  double force = 0;                // out of balance along it [N]
  std::vector<BodyMotion> bodies;  // those that move by more than a third, farthest first
};

/// The softest at the last Dynamics::evaluate(): of the least eigenvalue of K φ = λ M φ, by inverse
/// iteration with the matrix of `equilibrium`. Where the consistent matrix is not
/// positive definite it is that of the projected one.
/// @return nothing where no body can move or the matrix can't be solved with
std::optional<SoftMotion> find_softest_motion(const Model& model, Dynamics& dynamics,
                                              Equilibrium& equilibrium);

}  // namespace articular::sim
