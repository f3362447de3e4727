#pragma once

#include <Eigen/Core>

namespace articular::collision {

/// The test that decides on a pair of elements with overlapping boxes.
enum class NarrowTest { SeparatingAxes, Gjk };

/// The rule that every query equals, whatever its way to the pairs: along no axis of coordinates is
/// there a gap of more than the margin [m] between the boxes of the two elements (differences in
/// double precision; boxes that touch overlap), and the narrow test lets them meet.
/// That is separating_axes_overlap() without a margin and face_planes_overlap() with one, or
/// gjk_overlap().
bool elements_meet(const Eigen::Matrix3d& triangle, const Eigen::Matrix<double, 3, 4>& tetrahedron,
                   double margin, NarrowTest narrow);

/// With a margin [m]: whether no plane of a face of one of the two separates triangle and
/// tetrahedron by more than the margin. True for all that are nearer than that, and near edges and
/// corners for some that are farther.
bool face_planes_overlap(const Eigen::Matrix3d& triangle,
                         const Eigen::Matrix<double, 3, 4>& tetrahedron, double margin);

}  // namespace articular::collision
