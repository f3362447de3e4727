#pragma once

#include <Eigen/Core>

namespace articular {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vec9 = Eigen::Matrix<double, 9, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9>;
using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

/// Positions of nodes, one column a node [m].
using Positions = Eigen::Matrix3Xd;
/// Tetrahedra, one column an element: node indices, positively oriented (volume > 0 at rest).
using Tetrahedra = Eigen::Matrix4Xi;
/// Along the fibres at rest, one column a tetrahedron. The length is how densely they lie there:
/// what they pull, whatever their law, is so many times that of the law. 1: as the law says.
using FibreDirections = Eigen::Matrix3Xd;
/// Triangles, one column a face: node indices, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix3Xi;

}  // namespace articular
