#pragma once

#include <Eigen/Core>
#include <vector>

#include "collision/mesh/eigen_alignment.hpp"

namespace articular::collision {

/// Faces and neighbours of a tetrahedral mesh, from its connectivity alone ("The Organic Tissue").
struct Surface {
  Eigen::Matrix3Xi faces;  // node indices, counter-clockwise from outside for positive tetrahedra
  std::vector<int> face_tet;        // the tetrahedron a face belongs to
  Eigen::Matrix4Xi neighbours;      // 4 x M: tetrahedron across the face opposite node k, or -1
  std::vector<int> tet_face_begin;  // M + 1: faces of tet t are tet_faces[begin[t] .. begin[t+1])
  std::vector<int> tet_faces;
};

/// @throws std::invalid_argument for an index out of range, a repeated node in one tetrahedron, or
/// a
///         face shared by more than two tetrahedra
Surface build_surface(const Eigen::Matrix4Xi& tets, int num_nodes);

}  // namespace articular::collision
