#pragma once

#include "tools/anatomy/anatomy_mesh.hpp"

/// Rows of teeth that guide the jaw: upper front teeth stand in front of the lower ones, and back
/// teeth have cusps that fit into each other. mm; frame of the jaw. Both rows are swept along the
/// arch of arch_point(), and share the surface at which they meet, kOcclusalGap apart upwards.
///
/// Across the arch, front teeth and back teeth (palate on the left, lip and cheek on the right):
///
///       \  upper    |  |                     |    upper       |
///        \__        |  |                     |_              _|
///      ____  '\     |  |               ____    \     ___    /_
///     /  E  \  '\   |  | kOverbite    / A  \    \ C /   E \_/
///    | lower |   '\_|  |             |      \.___.'        |  lower
///
/// Lower tips A and E are at the occlusal level, and an upper tip is in the fossa C. In front these
/// are one edge. From E outwards the guiding incline goes down to the upper outer tip: the inner
/// face of an incisor or a canine, or of an upper buccal cusp.
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
constexpr double kTeethEnd = 54;         // back of the second molars, along the lower arch

/// What a section across the arch is made of [mm, degrees].
struct ToothSection {
  double guiding_deg;  // of the incline from E outwards
  double cusp_deg;     // of the walls of the fossa
  double half_width;   // from a lower tip to the fossa
  double tip;          // half the width of flat tips
  double overbite;
  double drop;      // of the lower tips below the occlusal level: 0 on a cusp, most between cusps
  double notch;     // 0 in the middle of a tooth, 1 between two teeth
  double backness;  // 0 front teeth, 1 back teeth
};

/// @param s             along the lower arch from the midline, in [0, kTeethEnd]
/// @param guidance_deg  of the central incisors
ToothSection tooth_section(double s, double guidance_deg = kGuidanceDeg);

/// Closed surfaces, outward normals, exact mirror images about x = 0.
/// @throws std::invalid_argument  for guidance_deg outside [40, 65]
Mesh lower_guiding_teeth(double guidance_deg = kGuidanceDeg);
Mesh upper_guiding_teeth(double guidance_deg = kGuidanceDeg);

}  // namespace articular::anatomy
