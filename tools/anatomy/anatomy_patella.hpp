#pragma once

#include "tools/anatomy/anatomy_knee_tissue.hpp"
#include "tools/anatomy/anatomy_solids.hpp"

/// The patella in front of the trochlea, of a right knee in extension. mm.
///
/// Its articular surface looks back. It has a ridge along the middle with a facet on either side,
/// both a little rounded:
///
///      lateral           y posterior         medial
///       `--.._          ^           _..-'
///             `--..___.-'-.____..--'
namespace articular::anatomy {

/// Posterior surface of the patella: y at (x, z). It leaves kJointGap to the trochlea.
double patella_back(double x, double z);

/// @param mean  thickness, volume by articular area. Nodes come in layers, as in
/// femoral_cartilage().
Mesh patellar_cartilage(double mean, const KneeResolution& resolution);
/// Thickness in the middle of that layer.
double patellar_full_thickness(double mean);

/// To the bone under that cartilage; about a distance near its surface.
Distance patella_distance(double mean);

/// That bone: a closed surface.
/// @param h  spacing of the contoured grid
Mesh patella_surface(double h, double mean);

/// Where tendons insert, in the middle.
Vec3 patella_apex();
Vec3 patella_base();

}  // namespace articular::anatomy
