#pragma once

#include "tools/anatomy/anatomy_knee_joint.hpp"
#include "tools/anatomy/anatomy_solids.hpp"

/// Distal femur and proximal tibia with fibula, of the right knee in extension: closed surfaces to
/// look at. Below the cartilage they are the surface that it grows on. mm.
namespace articular::anatomy {

/// @param h  spacing of the contoured grid
Mesh femur_surface(double h, const Compartment& medial, const Compartment& lateral);
/// The femur with a groove for the patella, whose cartilage is that thick on average.
Mesh femur_with_trochlea_surface(double h, const Compartment& medial, const Compartment& lateral,
                                 double trochlear_thickness);
Mesh tibia_surface(double h, const Compartment& medial, const Compartment& lateral);

/// About the distance to these surfaces, < 0 inside; the femur without the groove.
Distance femur_distance(const Compartment& medial, const Compartment& lateral);
Distance tibia_distance(const Compartment& medial, const Compartment& lateral);

}  // namespace articular::anatomy
