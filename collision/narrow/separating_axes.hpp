#pragma once

#include <Eigen/Core>

namespace articular::collision {

/// Whether a triangle and a tetrahedron, as closed sets, are within the margin [m] of each other:
/// false only if an axis separates them, with a gap along the unit axis larger than the margin.
/// Corners are columns, in any order: the sign of the tetrahedron's volume does not matter.
///
/// The rule, for every shape, those without volume, area or length included:
///  - shapes that touch overlap, and so do those that round-off cannot tell from touching: with a
///    gap beyond the margin of less than about 1e-14 of the pair's size (largest coordinate of a
///    corner relative to another);
///  - a larger gap is found, because the axes tried are all directions that can join two nearest
///    points of the shapes: the normals of the faces, the products of edge and edge, the
///    perpendiculars from a corner to an edge and the lines from corner to corner. The longest gap
///    along these is the distance, whatever the shapes. The usual axes (the first two kinds) are
///    enough for a tetrahedron with volume, but they show a gap that may be any part of the
///    distance, for slivers less than round-off, and for flat shapes in one plane none at all.
///
/// The answer depends neither on the unit of length nor, but for what the differences of the
/// coordinates lose, on the position. Positions and their differences must be finite, margin ≥ 0.
bool separating_axes_overlap(const Eigen::Matrix3d& triangle,
                             const Eigen::Matrix<double, 3, 4>& tetrahedron, double margin = 0);

}  // namespace articular::collision
