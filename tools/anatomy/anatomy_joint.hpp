#pragma once

#include <array>
#include <vector>

#include "tools/anatomy/anatomy_mesh.hpp"

/// The temporomandibular joint as smooth surfaces: condyle head, fossa with eminence, and the disc
/// that fills the gap between them. Lengths in mm, as published; frame of the jaw: x left,
/// y posterior, z up. All functions give the left joint.
///
/// Sagittal plane through the condyle (anterior to the left); C is the centre of the head:
///
///        postglenoid wall      ____ roof
///                         \ .-'    '-.  slope, kSlopeDeg to the horizontal
///      anterior            (   disc   \                         posterior
///      <--- 8 mm+ ---. crest \ .--. __/
///                     '-----' ( C  )
///
/// The sagittal profile is a chain of arcs and lines without kinks; at the mediolateral distance x
/// from the middle it is offset by fossa_drop(x) towards the condyle (the trough of the fossa).
/// On the medial side a wall hangs from it, kMedialWall from the middle and further off in front:
/// it stops the condyle that goes forward from drifting inwards. The head is a body of revolution
/// about the transverse axis, so that hinge rotation alone leaves the gap as it is.
namespace articular::anatomy {

/// Centre of the left condyle head. With the incisor edge at kIncisor: 100 mm between the condyles,
/// 101 mm from condyle to incisor, 88 mm from the incisor to the condylar axis.
inline const Vec3 kCondyle(50, 31.5, 81.5);
inline const Vec3 kIncisor(0, -47, 42);
constexpr double kCondyleRadius = 5;     // sagittal: 10 mm anteroposterior
constexpr double kCondyleHalfWidth = 9;  // 18 mm mediolateral
constexpr double kSlopeDeg = 42;         // of the eminence's posterior face
constexpr double kEminenceHeight = 6;    // from roof to crest
constexpr double kDiscHalfWidth = 11;    // 22 mm mediolateral
constexpr double kMedialWall = 11.6;     // of the fossa, from the condyle centre
/// Clearance between disc and bone. The disc's faces are chords of the head: with edges of 1.2 mm
/// they dip h²/8R = 0.036 mm below their nodes, so the lower clearance is the larger one.
constexpr double kLowerClearance = 0.045;
constexpr double kUpperClearance = 0.03;

/// One arc or line of the fossa's profile, from posterior to anterior.
struct ProfilePiece {
  Vec2 start;
  double heading;    // at the start [rad], 0 = forward, > 0 = up
  double curvature;  // [1/mm], > 0 turns up (convex eminence), < 0 concave roof, 0 line
  double length;
};

/// Wall, roof, slope, crest, preglenoid plane.
using FossaProfile = std::array<ProfilePiece, 5>;

/// @throws std::invalid_argument  for a slope outside [30, 55] degrees
FossaProfile fossa_profile(double slope_deg);
/// That with kSlopeDeg.
const FossaProfile& usual_fossa();

/// Radius of the condyle head at the mediolateral distance x from its centre, |x| <=
/// kCondyleHalfWidth.
double condyle_radius(double x);

/// Signed distance from the fossa surface, > 0 below it (in the joint), near the joint.
/// @param p  relative to the condyle centre
double distance_below_fossa(const Vec3& p, const FossaProfile& fossa = usual_fossa());

/// Upper part of the head as an open sheet, outward normals.
/// @param h  edge length
Mesh condyle_sheet(double h);

/// Postglenoid wall, roof, slope, crest and 15 mm beyond it, and the medial wall that hangs from
/// them; normals into the joint.
Mesh fossa_sheet(double h, const FossaProfile& fossa = usual_fossa());

/// The disc: tetrahedra of edge h along the surface, two layers at h = 1.2 mm. Fibres run fore and
/// aft in the intermediate zone, and across in both bands.
/// @throws std::invalid_argument for h outside [0.3, 2.5] mm
Mesh disc(double h, const FossaProfile& fossa = usual_fossa());

/// The same on the other side: x -> -x, orientation kept outward.
Mesh mirrored(const Mesh& mesh);

/// Triangles between two polylines of different lengths, by the shorter diagonal. Normal: along
/// a x (from a to b), with a the direction of the polylines.
/// @param a, b  node numbers of the rows
void stitch(const std::vector<int>& a, const std::vector<int>& b, const std::vector<Vec3>& nodes,
            std::vector<Eigen::Vector3i>& triangles);

}  // namespace articular::anatomy
