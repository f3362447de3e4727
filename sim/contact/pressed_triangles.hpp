#pragma once

#include <vector>

#include "sim/contact/contact_response.hpp"

/// The pressure of a contact as a field on pieces of the surface: p = Σ N_a p_a where depths are
/// averaged, k d where they count point by point.
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

}  // namespace articular::sim
