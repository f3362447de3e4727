#pragma once

#include <vector>

#include "tools/anatomy/anatomy_fibre_body.hpp"

/// Muscles of the jaw as bodies of tissue, between "skull" and "mandible". mm; left side.
namespace articular::anatomy {

/// Both parts of the masseter, temporalis, medial pterygoid, and the inferior head of the lateral
/// pterygoid. The volumes are about those of the fibres of the lines of mandible_muscles (PECK):
/// physiological cross-section times the part of the length that is no tendon. The temporalis has
/// less room, and 0.6 of that. That line of the lateral pterygoid has no tendon, but fibres of
/// people are 23 mm long there (VE-PT), shorter than the line; the volume is that of these fibres.
std::vector<FibreBody> muscle_shapes();

/// Nodes that lie on the bone of an end: nearer than kAttachedWithin, all others farther than that.
constexpr double kAttachedWithin = 1.0;

/// A muscle as tetrahedra of about the size h, with its fibres.
/// @throws std::invalid_argument for h outside [3, 6] mm
Mesh muscle_mesh(const FibreBody& muscle, double h);

/// The parts of both bones that these muscles touch, for contact: ramus with coronoid, temporal
/// fossa with zygomatic arch, and pterygoid plate. Open sheets, outward normals; left side.
/// @param h  spacing of the contoured grid
Mesh ramus_sheet(double h);
Mesh temporal_sheet(double h);
Mesh pterygoid_sheet(double h);

}  // namespace articular::anatomy
