#pragma once

#include "tools/anatomy/anatomy_joint.hpp"
#include "tools/anatomy/anatomy_solids.hpp"

/// Mandible, hyoid and skull parts to look at, with teeth. Unions of thick
/// triangles and superellipsoids, symmetric about x = 0. mm.
namespace articular::anatomy {

/// Closed surface, outward normals: body with chin, both rami with coronoid and condyle, lower
/// teeth.
/// @param h  spacing of the contoured grid
Mesh mandible_surface(double h);

/// Closed surface: upper teeth and maxilla, zygomatic arches, temporal bones with fossa, eminence
/// and styloid process.
Mesh skull_surface(double h, const FossaProfile& fossa = usual_fossa());

/// The same without styloid process, which no muscle of tissue touches.
Mesh skull_without_styloid(double h);

/// Closed surface: the body of the hyoid with its greater horns.
Mesh hyoid_surface(double h);

/// Signed distances from both bones before they are contoured, < 0 inside; to use for x >= 0. The
/// skull's is without its styloid process.
Distance mandible_distance();
Distance skull_distance(const FossaProfile& fossa = usual_fossa());

/// Occlusal strips that meet at closed mouth with a gap of kOcclusalGap; normals up (lower), down
/// (upper).
Mesh lower_teeth_sheet(double h);
Mesh upper_teeth_sheet(double h);
constexpr double kOcclusalGap = 0.3;

/// Middle of the lower dental arch at the distance |x| from the midline: occlusal level. x in
/// 0..27.
Vec3 arch_point(double x);

}  // namespace articular::anatomy
