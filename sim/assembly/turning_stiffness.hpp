#pragma once

#include <vector>

#include "sim/assembly/moment.hpp"

namespace articular::sim {

/// What forces add to the stiffness of rigid bodies by turning with them. The point of a force f is
/// p + R r: as R turns by θ, it moves by θ × R r + θ × (θ × R r)/2. So each f on a lever r adds
///
///   K = (f·r) I − (f rᵀ + r fᵀ)/2
///
/// to the turning of its body [N m]. It is what a pendulum swings by. The derivative of the moment
/// τ has [τ]×/2 beside it, which is not symmetric and vanishes where moments balance.
///
/// Of lines, forces, weights and tied tissue. Not of contact: its points are none of the body, they
/// slide on as it turns. Newton's matrix is without K, which may be negative: with it equilibria of
/// the shipped jaw and knee take as many iterations, or up to a tenth more.
/// @return of each rigid body that moves
std::vector<Mat3> turning_stiffness(const Moment& now);

}  // namespace articular::sim
