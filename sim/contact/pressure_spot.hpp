#pragma once

#include <vector>

#include "sim/contact/pressed_triangles.hpp"

/// The largest mean pressure over a spot of a given size, as a sensor or a pressure film of that
/// size tells it.
///
/// Through a face, or around a node, a peak is a mean over whatever size a face has. Here it is
///
///   p(c) = 1/(π r²) ∫_{|x − c| < r} p dA,
///
/// the force through what lies within r of a point c of the surface, by the area of the spot. On a
/// sphere just π r² lie within r of a point. Where the spot reaches beyond what touches, nothing
/// presses on the rest of it. Discs are cut with the patches exactly, so p(c) does not jump as c
/// moves, and does not depend on how a surface is cut into faces.
namespace articular::sim {

/// ∫ p dA over what of the triangles lies within r of c [N].
double force_within(const std::vector<PressedTriangle>& triangles, const Vec3& c, double r);

/// max p(c) [Pa] over points c of the triangles, which are tried ever more closely around the best
/// one: first r/2 apart, at last r/32.
/// @param r  [m], > 0
double largest_spot_pressure(const std::vector<PressedTriangle>& triangles, double r);

}  // namespace articular::sim
