#pragma once

#include <vector>

#include "sim/contact/contact_pair_state.hpp"
#include "sim/gap/triangle_polygon.hpp"

/// How much of a surface carries, finer than its elements.
///
/// Point by point that is where d > 0. Averaged depths only say which nodes press. Between one that
/// does and one that does not lies the edge, where the linear field of
///
///   φ_a = p_a where a presses, else −gap_a/c_a
///
/// is zero, with the gap from the node to the face opposite. φ_a is the pressure that would have to
/// pull on the area T_a around the node to close it: that of a half space of each side under a
/// round punch of this area [Johnson 1985, ch. 3.6], and of their layers l,
///
///   c_a = √(π T_a) Σ (1 − ν²)/2E + l.
///
/// To count the whole area around each node that presses, and none around others, made the radius
/// of a sphere's contact too small by a third of an element (sim/RESULTS.md).
///
/// [Johnson 1985] Johnson. Contact Mechanics. Cambridge University Press.
namespace articular::sim {

/// φ [Pa] by smoothing group of the triangles' side; −∞ where no triangle meets a face.
Eigen::VectorXd signed_pressures(const Model& model, const ContactPairState& pair_state);

/// Whether a patch counts for a part of a body's surface.
/// @param selected  by face of that body's collider, one of the two sides; empty: all
bool is_selected(const ContactSides& sides, const ContactPairState::Patch& entry, int body,
                 const std::vector<char>& selected);

/// The part of its triangle that a patch covers.
TrianglePolygon covered_polygon(const ContactPatch& patch);

/// What of a patch carries, at rest [m²].
/// @param phi  at the nodes of its triangle
double area_that_carries(const ContactPatch& patch, const Vec3& phi);

}  // namespace articular::sim
