#pragma once

#include "tools/anatomy/anatomy_fibre_body.hpp"
#include "tools/anatomy/anatomy_knee_joint.hpp"

/// The patellar tendon of the right knee as a body of tissue, between "patella" and "tibia": a band
/// from the front of the patella's apex to the tuberosity. mm.
namespace articular::anatomy {

FibreBody patellar_tendon();

/// The band as tetrahedra of about the size h, with its fibres. Its ends sit 0.3 mm from their bone
/// by their inner side; the rest is farther away.
/// @param patellar_thickness  mean, of the patella's cartilage
/// @throws std::invalid_argument for h outside [1.5, 4] mm
Mesh patellar_tendon_mesh(const Compartment& medial, const Compartment& lateral,
                          double patellar_thickness, double h);

}  // namespace articular::anatomy
