#pragma once

#include "tools/anatomy/anatomy_fibre_body.hpp"
#include "tools/anatomy/anatomy_knee_joint.hpp"

/// Ligaments of the right knee as bodies of tissue, between "femur" and "tibia", where the bundles
/// of lines begin and end. mm.
namespace articular::anatomy {

/// Superficial medial collateral ligament: a band over the edge of the tibia.
FibreBody medial_collateral();
/// Anterior cruciate ligament: a ribbon from the wall of the notch to the front of the eminence.
FibreBody anterior_cruciate();

/// Nodes that sit on a bone are nearer to it than this, all others are farther away.
constexpr double kTiedWithin = 0.6;

/// A ligament as tetrahedra of about the size h, with its fibres.
/// @throws std::invalid_argument for h outside [1.5, 4] mm: finer ones have more than one layer
/// within kTiedWithin
Mesh ligament_mesh(const FibreBody& ligament, const Compartment& medial, const Compartment& lateral,
                   double h);

/// The parts of both bones that these ligaments touch, for contact: open sheets, outward normals.
/// @param h  spacing of the contoured grid
Mesh femoral_side_sheet(double h, const Compartment& medial, const Compartment& lateral);
Mesh tibial_side_sheet(double h, const Compartment& medial, const Compartment& lateral);
Mesh notch_sheet(double h, const Compartment& medial, const Compartment& lateral);
Mesh eminence_sheet(double h, const Compartment& medial, const Compartment& lateral);

}  // namespace articular::anatomy
