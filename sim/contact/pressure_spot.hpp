#pragma once

#include <vector>

#include "sim/contact/contact_response.hpp"

/// The largest mean pressure over a spot of a given size, as a sensor or a pressure film of that
/// size tells it.
///
/// Through a face, or around a node, a peak is a mean over whatever size a face has. Here it is
///
///   p(c) = 1/(π r²) ∫_{|x − c| < r} p dA,   p = Σ N_a p_a, or k d, on the patches,
///
/// the force through what lies within r of a point c of the surface, by the area of the spot. On a
/// sphere just π r² lie within r of a point. Where the spot reaches beyond what touches, nothing
/// presses on the rest of it. Discs are cut with the patches exactly, so p(c) does not jump as c
/// moves, and does not depend on how a surface is cut into faces.
namespace articular::sim {

/// A flat triangle, and the pressure on it, which is affine.
struct PressedTriangle {
  Mat3 x = Mat3::Zero();  // corners, one a column [m]
  Vec3 p = Vec3::Zero();  // there [Pa]
};

/// What a contact puts on those of its patches that count, where the surfaces are now. On a patch
/// that fades p is not affine; it is made so, for the same force.
/// @param selected  by face of the body's collider, one of the contact's two; empty: all
void add_pressed_triangles(const Model& model, const ContactResponse& response,
                           const Configuration& configuration, ContactId contact, int body,
                           const std::vector<char>& selected,
                           std::vector<PressedTriangle>& triangles);

/// ∫ p dA over what of the triangles lies within r of c [N].
double force_within(const std::vector<PressedTriangle>& triangles, const Vec3& c, double r);

/// max p(c) [Pa] over points c of the triangles, which are tried ever more closely around the best
/// one: first r/2 apart, at last r/32.
/// @param r  [m], > 0
double largest_spot_pressure(const std::vector<PressedTriangle>& triangles, double r);

}  // namespace articular::sim
