#pragma once

#include <vector>

#include "sim/contact/contact_response.hpp"

/// Contact pressure as a field on surfaces.
///
/// On a patch the pressure is a density over its polygon: where depths are averaged Σ N_a p_a,
/// point by point k d. Both are nowhere negative there, though k d at the triangle's nodes may be.
/// Damping acts with one pressure around a node, which where surfaces part is negative, but for an
/// average only: point by point it is spread as k d is, k d Σ N_a p_a/(k g_a), so that no part of a
/// surface pulls and the sum stays.
///
/// With M_f the patches on a face f, by the normal of which they act, and A_f its area now,
///
///   p_f = Σ_{M_f} ∫ p dA / A_f,   so that Σ p_f A_f is the normal force;
///
/// around a node a, over the faces of its smooth group,
///
///   p_a = Σ ∫ N_a p dA / Σ ∫ N_a dA over what lies opposite and carries, now:
///
/// a projection with a lumped mass matrix, no larger than p is anywhere there. Where less than
/// kResolvedShare of a group lies opposite, the mean is over a sliver, whose p a mesh of that size
/// does not resolve: it is blank. [Wriggers 2006, ch. 9] has the projection.
///
/// [Wriggers 2006] Wriggers. Computational Contact Mechanics, 2nd ed. Springer.
namespace articular::sim {

/// Of the area around a node, to tell a pressure there.
inline constexpr double kResolvedShare = 0.25;
/// Nodes with a pressure, to tell those of a contact: fewer span no area.
inline constexpr int kResolvedNodes = 3;

/// ∫ N_i p dA by node i of a patch's triangle [N], none negative.
Vec3 pressure_integrals(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                        const Eigen::Matrix3Xi& groups);

/// Areas of a collider's faces now [m²].
Eigen::VectorXd face_areas(const Configuration& configuration, const Collider& collider);

/// What patches put on one body's surface.
struct SurfaceLoad {
  Eigen::VectorXd face_area;       // now [m²]
  Eigen::VectorXd through;         // by face: normal force [N]
  Eigen::VectorXd force, covered;  // by smoothing group: Σ ∫ N p dA [N], Σ ∫ N dA [m²], now
};
SurfaceLoad no_load(const Configuration& configuration, const Collider& collider);

/// @param on_triangles, on_faces  of the two sides; of a body with itself the same
void add_load(const ContactSides& side, const ContactPairState& pair_state, double share,
              const ContactPairState::Patch& entry, SurfaceLoad& on_triangles,
              SurfaceLoad& on_faces);

/// Area now around each smoothing group [m²].
Eigen::VectorXd group_areas(const Collider& collider, const SurfaceLoad& load);
/// By smoothing group [Pa]; 0 where nothing presses, NaN where the pressure is not resolved.
Eigen::VectorXd group_pressures(const Collider& collider, const SurfaceLoad& load);
/// By node: the largest of its groups.
Eigen::VectorXd node_pressures(const Collider& collider, const SurfaceLoad& load);
/// By face [Pa].
Eigen::VectorXd face_pressures(const SurfaceLoad& load);

/// Of all contacts, by body; of one that touches nothing empty.
std::vector<SurfaceLoad> surface_loads(const Model& model, const ContactResponse& response,
                                       const Configuration& configuration);

}  // namespace articular::sim
