#pragma once

#include <Eigen/Core>

namespace articular::collision {

/// Convex hull of points, one a column [m]: triangle, tetrahedron, hexahedron, ...
using ConvexPoints = Eigen::Ref<const Eigen::Matrix3Xd>;

enum class GjkOutcome {
  Separated,     // a separating plane was found
  Intersecting,  // a common point was found, up to round-off
  Undecided,     // neither: touching within round-off, or a flat difference of the two shapes
};

/// The algorithm of Gilbert, Johnson and Keerthi ("Colliding BucketTrees") for two convex shapes,
/// each swept by a sphere of radius margin/2 [m] (so "intersecting" means a distance of at most
/// margin).
///
/// The answer does not depend on the unit of length: the pair is moved to the centre of its common
/// box and divided by the size of that box, because libccd compares lengths to the 4th and 6th
/// power with an absolute constant. Shapes nearer than about 1e-7 of the pair's size count as
/// touching.
GjkOutcome gjk(const ConvexPoints& a, const ConvexPoints& b, double margin = 0);

/// Without a separating plane the shapes count as intersecting: no contact is lost to round-off.
inline bool gjk_overlap(const ConvexPoints& a, const ConvexPoints& b, double margin = 0) {
  return gjk(a, b, margin) != GjkOutcome::Separated;
}

}  // namespace articular::collision
