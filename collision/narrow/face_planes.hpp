#pragma once

#include <Eigen/Core>

namespace articular::collision {

enum class PlaneVerdict { Apart, Overlapping, Unknown };

/// What the planes of the tetrahedron's faces and of the triangle tell at once: most pairs with
/// overlapping boxes. Apart: one of them separates the two by more than the margin. Overlapping: a
/// corner of the triangle lies inside the tetrahedron. The verdict keeps clear of touching by 1e-6
/// of the pair's size, so that it is never other than what GJK would find.
/// @param margin  [m]
PlaneVerdict face_planes(const Eigen::Matrix3d& triangle,
                         const Eigen::Matrix<double, 3, 4>& tetrahedron, double margin);

}  // namespace articular::collision
