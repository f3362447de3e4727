#pragma once

#include "tools/anatomy/anatomy_mesh.hpp"

/// Rows of teeth that guide the jaw: upper front teeth stand in front of the lower ones, and back
/// teeth have cusps that fit into each other. mm; frame of the jaw. Both rows are swept along the
/// arch of arch_point(), and share the surface at which they meet, kOcclusalGap apart upwards.
///
/// The lower surface across the arch, from the tongue outwards:
///
///      A         E                    A, E  lower tips, at the occlusal level
///    /   \     /  \                   C     fossa, in which an upper tip lies
///         \_C_/    \                  D     upper outer tip: incisal edge or buccal cusp
///                   \__D             E-D   guiding incline, of which the lower tooth has a part
///
/// In front A, C and E are one edge, and E-D is as high as the overbite.
///
/// Sources (scenarios/SOURCES.md): slopes of the inner faces, 57 degrees at central incisors and 47
/// at canines, in the mean; overbite and overjet. Ours: cusps, and all widths and fillets.
namespace articular::anatomy {

constexpr double kGuidanceDeg = 57;    // inner faces of the central incisors, to the horizontal
constexpr double kCanineLessDeg = 10;  // those of canines and lateral incisors are flatter by this
constexpr double kCuspDeg = 25;        // walls of the fossae, and inner faces of buccal cusps
constexpr double kOverbite = 2.45;     // of the front teeth
constexpr double kBackOverbite = 0.7;  // of the buccal cusps
constexpr double kCanineMiddle = 14.75;  // along the lower arch, from the midline

/// Closed surfaces, outward normals, exact mirror images about x = 0.
/// @throws std::invalid_argument  for guidance_deg outside [40, 65]
Mesh lower_guiding_teeth(double guidance_deg = kGuidanceDeg);
Mesh upper_guiding_teeth(double guidance_deg = kGuidanceDeg);

}  // namespace articular::anatomy
