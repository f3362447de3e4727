#pragma once

#include "tools/anatomy/anatomy_knee_tissue.hpp"

/// Menisci of the knee as tetrahedra. mm.
namespace articular::anatomy {

/// Between condyle and plateau, bent to a C from the anterior to the posterior horn, with fibres
/// along the rim. A section, with the inner edge on the left:
///
///                    __.---.
///            __..--''       )     upper face: along the condyle, up to the rim's height
///       __.-'               |
///      (_________________.-'      lower face: along the plateau
///
/// The shape does not depend on the resolution. Towards the inner edge both faces leave their
/// cartilage little by little, and both edges are round: none digs into cartilage.
Mesh meniscus(const Compartment& c, const KneeResolution& resolution);

/// Middle of a horn's end face. @param end  -1 anterior, 1 posterior
Vec3 horn(const Compartment& c, int end);

}  // namespace articular::anatomy
