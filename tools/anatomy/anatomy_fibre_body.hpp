#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/anatomy/anatomy_solids.hpp"

/// Muscles and ligaments as bodies of tissue. Each is a sheet of fibres between two bones, given by
/// rows across the fibres from origin to insertion, and as thick as they say:
///
///      front ---- middle ---- back      row 0, at the origin         x: from front to back
///         \          |         /                                     w: along the fibres
///          front - middle - back        last row, at the insertion   normal: w x x, outwards
///
/// Outwards is away from the bone that the ends sit on. Where that is towards the middle of the
/// head, front and back change places.
///
/// An end sits on its bone by its face, or by the inner side of the last part of the sheet.
/// Elsewhere the sheet keeps clear of the bones. Lengths in mm.
namespace articular::anatomy {

/// A row of a sheet: a parabola through three points, and half the thickness there.
struct FibreRow {
  Vec3 front, middle, back;
  double half_thickness;
};

/// How an end of a sheet sits on its bone.
struct FibreEnd {
  std::string bone;
  double side_part = 0;  // of the length that sits on the bone by its inner side; 0: by its face
};

struct FibreBody {
  std::string name;
  std::vector<FibreRow> rows;  // from origin to insertion, two or more
  FibreEnd origin, insertion;
  double seated = 0.5;  // from the bone, of nodes that sit on it
  double clear = 1.6;   // from all bones, of the others: at least
};

using Bones = std::map<std::string, Distance>;

/// The body as tetrahedra of about the size h, with the same fibres from end to end along the
/// harmonic field: the length of their directions is how densely they lie, 1 on average.
Mesh fibre_body_mesh(const FibreBody& body, const Bones& bones, double h);

/// Nodes of that mesh that sit on the bones, in ascending order.
struct FibreEnds {
  std::vector<int> origin, insertion;
};
FibreEnds fibre_body_ends(const FibreBody& body, double h);

}  // namespace articular::anatomy
