#pragma once

#include <Eigen/Core>

namespace articular::collision {

/// Corners of an element, one a column.
template <int num_nodes, class Nodes>
Eigen::Matrix<double, 3, num_nodes> corners(const Eigen::Matrix3Xd& x, const Nodes& nodes) {
  Eigen::Matrix<double, 3, num_nodes> p;
  for (int k = 0; k < num_nodes; ++k) p.col(k) = x.col(nodes[k]);
  return p;
}

/// Rule of one mesh with itself (erratum 8): contact at a common node is no penetration.
inline bool have_common_node(const Eigen::Matrix3Xi& faces, int face, const Eigen::Matrix4Xi& tets,
                             int tet) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      if (faces(i, face) == tets(j, tet)) return true;
  return false;
}

}  // namespace articular::collision
