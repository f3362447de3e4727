#pragma once

#include "sim/assembly/moment.hpp"
#include "sim/model/system_matrix.hpp"

namespace articular::sim {

/// A += scale times what forces add to the stiffness of rigid bodies by turning with them. The
/// point of a force f is p + R r: as R turns by θ, it moves by θ × R r + θ × (θ × R r)/2. So each f
/// on a lever r adds
///
///   K = (f·r) I − (f rᵀ + r fᵀ)/2
///
/// to the turning of its body [N m]. It is what a pendulum swings by. The derivative of the moment
/// τ has [τ]×/2 beside it, which is not symmetric and vanishes where moments balance.
///
/// Of all forces: K of a contact belongs to its curvature by the nodes (contact_stiffness.hpp), as
/// what touches slides on while its body turns. It may be negative.
void add_turning_stiffness(const Moment& now, double scale, fem::BlockMatrix& A);

}  // namespace articular::sim
