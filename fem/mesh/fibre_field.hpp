#pragma once

#include <span>
#include <vector>

#include "fem/base/types.hpp"

/// Fibres at rest, one a tetrahedron.
namespace articular::fem {

/// The same direction everywhere. @throws std::invalid_argument unless it is finite and not 0
FibreDirections constant_fibres(const Vec3& direction, Eigen::Index num_elements);

/// From an array of a mesh: each column is normalised.
/// @throws std::invalid_argument naming an element whose direction is 0 or not finite
FibreDirections normalized_fibres(const Eigen::Matrix3Xd& directions);

/// Where fibres point once the nodes have moved from X to x: F a₀, of length 1.
FibreDirections moved_fibres(const Positions& X, const Tetrahedra& tets,
                             const FibreDirections& fibres, const Positions& x);

/// The potential φ with Δφ = 0 inside, φ = 0 on the nodes `from`, 1 on the nodes `to` and no flux
/// through the rest of the surface, with linear tetrahedra; one entry a node. A node that belongs
/// to no element has 0.
/// @throws std::invalid_argument naming a node that is out of range or in both sets, or an element
///         whose part of the mesh is not connected to both sets, or is not positive
Eigen::VectorXd harmonic_potential(const Positions& X, const Tetrahedra& tets,
                                   std::span<const int> from, std::span<const int> to);

/// Fibres from one attachment to the other, along the gradient of the harmonic potential, which
/// follows the shape of the tissue [Choi 2013]. The direction of an element is in error by O(h).
/// @throws std::invalid_argument as harmonic_potential, or naming an element where the gradient
///         vanishes (all of its nodes in one set, or a dead end)
///
/// [Choi 2013] Choi, Blemker. Skeletal muscle fascicle arrangements can be reconstructed using a
///             Laplacian vector field simulation. PLoS ONE 8(10).
FibreDirections harmonic_fibres(const Positions& X, const Tetrahedra& tets,
                                std::span<const int> from, std::span<const int> to);

/// The same fibres, as dense as that field's flux; by volume their mean density is 1. What flows in
/// at one end flows out at the other: where tissue narrows, all its fibres are still there, and a
/// pull that is the same in each of them is in balance along them.
FibreDirections conserved_fibres(const Positions& X, const Tetrahedra& tets,
                                 std::span<const int> from, std::span<const int> to);

/// What of the flux of fibres ends at nodes that are not held, by what ends at those that are:
/// Σ|d_a| over the first by that over the others, d_a = Σ_e V_e ρ a₀ · ∂N_a/∂X. 0 where all fibres
/// run from one held node to another; then a pull that is the same in each of them loads no other
/// node along its way. Infinite where none is held.
/// @param held  one a node
double loose_flux(const Positions& X, const Tetrahedra& tets, const FibreDirections& fibres,
                  const std::vector<bool>& held);

}  // namespace articular::fem
