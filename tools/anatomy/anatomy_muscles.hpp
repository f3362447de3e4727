#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/anatomy/anatomy_solids.hpp"

/// Closing muscles of the jaw as bodies of tissue. Each is a sheet of fibres between the two bones,
/// given by rows across the fibres from origin to insertion, and as thick as they say:
///
///      front ---- middle ---- back      row 0, at the origin         x: from front to back
///         \          |         /                                     w: along the fibres
///          front - middle - back        last row, at the insertion   normal: outwards (lateral)
///
/// An end sits on its bone by its face, or by the inner (medial) side of the last part of the
/// sheet. Elsewhere the muscle keeps clear of the bones. Lengths in mm; left side.
namespace articular::anatomy {

/// A row of a sheet: a parabola through three points, and half the thickness there.
struct MuscleSection {
  Vec3 front, middle, back;
  double half_thickness;
};

/// How an end of a muscle sits on its bone.
struct MuscleEnd {
  std::string bone;      // "skull" or "mandible"
  double side_part = 0;  // of the length that sits on the bone by its inner side; 0: by its face
};

struct MuscleShape {
  std::string name;
  std::vector<MuscleSection> sections;  // from origin to insertion, two or more
  MuscleEnd origin, insertion;
};

/// Masseter (both parts as one) and temporalis. The volumes are about those of the fibres of the
/// lines of mandible_muscles (PECK): physiological cross-section times the part of the length that
/// is no tendon. The temporalis has less room, and 0.6 of that.
std::vector<MuscleShape> closing_muscles();

/// Nodes that lie on the bone of an end: nearer than kAttachedWithin, all others farther than that.
constexpr double kAttachedWithin = 1.0;

/// A muscle as tetrahedra of about the size h, with the same fibres from end to end along the
/// harmonic field: the length of their directions is how densely they lie, 1 on average.
/// @throws std::invalid_argument for h outside [3, 6] mm
Mesh muscle_mesh(const MuscleShape& shape, double h);

/// Nodes of that mesh that sit on the bones, in ascending order.
struct MuscleEnds {
  std::vector<int> origin, insertion;
};
MuscleEnds muscle_ends(const MuscleShape& shape, double h);

/// The parts of both bones that these muscles touch, for contact: ramus with coronoid, and temporal
/// fossa with zygomatic arch. Open sheets, outward normals; left side.
/// @param h  spacing of the contoured grid
Mesh ramus_sheet(double h);
Mesh temporal_sheet(double h);

}  // namespace articular::anatomy
