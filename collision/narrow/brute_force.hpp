#pragma once

#include <vector>

#include "collision/mesh/aabb.hpp"
#include "collision/mesh/element_pair.hpp"
#include "collision/mesh/penetrations.hpp"
#include "collision/mesh/surface.hpp"
#include "collision/narrow/narrow_test.hpp"

/// All pairs with the same box test and narrow test as everything else: the reference for the
/// article's tree. Quadratic; for tests and measurements.
namespace articular::collision {

/// A deformed mesh.
struct MeshView {
  const Eigen::Matrix4Xi& tets;
  const Surface& surface;
  const Eigen::Matrix3Xd& x;  // [m]
};

/// The pairs (face of F, tetrahedron of W) that admit(face, tet) lets through, in ascending order.
/// Two closed boxes without a common point are apart whatever GJK makes of a gap of round-off.
template <class Admit>
std::vector<Penetration> brute_force_pairs(const MeshView& F, const MeshView& W, double margin,
                                           Admit&& admit) {
  std::vector<Penetration> pairs;
  for (int face = 0; face < F.surface.faces.cols(); ++face) {
    const Eigen::Vector3i face_nodes = F.surface.faces.col(face);
    const Aabb face_box = element_box(F.x, face_nodes, margin);
    const Eigen::Matrix3d triangle = corners<3>(F.x, face_nodes);
    for (int tet = 0; tet < W.tets.cols(); ++tet) {
      const Eigen::Vector4i tet_nodes = W.tets.col(tet);
      if (!admit(face, tet) || !overlap(face_box, element_box(W.x, tet_nodes, margin))) continue;
      if (elements_overlap(triangle, corners<4>(W.x, tet_nodes), margin))
        pairs.push_back({face, tet});
    }
  }
  return pairs;
}

/// Faces of F in tetrahedra of W, two bodies.
inline std::vector<Penetration> brute_force_collide(const MeshView& F, const MeshView& W,
                                                    double margin = 0) {
  return brute_force_pairs(F, W, margin, [](int, int) { return true; });
}

/// A body with itself, without the pairs that have a common node.
inline std::vector<Penetration> brute_force_self_intersections(const MeshView& mesh,
                                                               double margin = 0) {
  return brute_force_pairs(mesh, mesh, margin, [&](int face, int tet) {
    return !have_common_node(mesh.surface.faces, face, mesh.tets, tet);
  });
}

}  // namespace articular::collision
