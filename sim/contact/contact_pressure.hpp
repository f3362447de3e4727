#pragma once

#include <vector>

#include "sim/contact/contact_response.hpp"

/// Contact pressure as a field on surfaces.
///
/// On a patch it is a density over the polygon: Σ N_a p_a where depths are averaged, k d where they
/// count point by point. Both are nowhere negative there, though k d at the nodes of the triangle
/// may be. Dampers have one pressure around a node, which may be negative where surfaces part: on
/// points they act as a factor on k d, so that no part of a surface pulls and the sum around the
/// node is the same.
///
/// On a face of the area A_f now, with the forces of its patches along its normal,
///
///   p_f = Σ ∫ p dA / A_f,   so that Σ p_f A_f is the normal force;
///
/// around a node a, over the patches on the faces of a smoothing group,
///
///   p_a = Σ ∫ N_a p dA / Σ ∫ N_a dA,   areas now:
///
/// a projection with a lumped mass matrix, no larger than p is anywhere on these patches. As
/// averaged depths may make any p on a sliver, the mean is over kLeastShare of the group's area at
/// least: where the patches cover less, p falls to nothing with what they cover. Below kBlankShare
/// it is blank: there a mesh of that size says nothing of p. So it is where p is more than
/// kMostPeak times what it is around any neighbour, as one node does not resolve a peak, and around
/// those neighbours.
namespace articular::sim {

/// Of the area around a node.
inline constexpr double kLeastShare = 0.25, kBlankShare = 0.05;
/// Of the largest pressure around a neighbour.
inline constexpr double kMostPeak = 2.5;
/// Nodes of which at least kLeastShare carries, to tell the pressures of a contact: fewer span no
/// area.
inline constexpr int kResolvedNodes = 3;

/// ∫ N_i p dA by node i of a patch's triangle [N], none negative.
Vec3 pressure_integrals(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                        const Eigen::Matrix3Xi& groups);

/// What patches put on one body's surface.
struct PressureLoad {
  Eigen::VectorXd face_area;       // now [m²]
  Eigen::VectorXd through;         // by face: normal force [N]
  Eigen::VectorXd force, covered;  // by smoothing group: Σ ∫ N p dA [N], Σ ∫ N dA [m²], now
};
PressureLoad no_load(const Configuration& configuration, const Collider& collider);

/// @param on_triangles, on_faces  of the two sides; of a body with itself the same
void add_load(const ContactSides& side, const ContactPairState& pair_state, double share,
              const ContactPairState::Patch& entry, PressureLoad& on_triangles,
              PressureLoad& on_faces);

/// Area now around each smoothing group [m²].
Eigen::VectorXd group_areas(const Collider& collider, const PressureLoad& load);
/// By smoothing group [Pa]; 0 where nothing presses, NaN where it is blank.
Eigen::VectorXd group_pressures(const Collider& collider, const PressureLoad& load);
/// By node: the largest of its groups.
Eigen::VectorXd node_pressures(const Collider& collider, const PressureLoad& load);
/// By face [Pa].
Eigen::VectorXd face_pressures(const PressureLoad& load);

/// Of all contacts, by body; of one that touches nothing empty.
std::vector<PressureLoad> pressure_loads(const Model& model, const ContactResponse& response,
                                         const Configuration& configuration);

}  // namespace articular::sim
