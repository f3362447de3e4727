#pragma once

#include "sim/gap/contact_patch.hpp"

/// How points of a patch's triangle move from those of the face opposite: u, see contact_patch.cpp.
namespace articular::sim {

using Mat18x3 = Eigen::Matrix<double, 18, 3>;

/// direction·u_i for the three nodes of s, of the 18 displacements.
inline Mat18x3 opposite(const ContactPatch& patch, const Vec3& direction) {
  Mat18x3 rows;
  const Vec3 tilt = patch.g.transpose() * direction;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      rows.block<3, 1>(3 * j, i) = patch.height[i] * tilt[j] * patch.normal;
      rows.block<3, 1>(9 + 3 * j, i) = -patch.beta(j, i) * direction;
    }
    rows.block<3, 1>(3 * i, i) += direction;
  }
  return rows;
}

/// sum += opposite(patch, direction) * q.
template <class Sum>
void add_opposite(const ContactPatch& patch, const Vec3& direction, const Vec3& q, Sum&& sum) {
  const double height = q.dot(patch.height);
  const Vec3 reaction = patch.beta * q;
  for (int j = 0; j < 3; ++j) {
    sum.template segment<3>(3 * j) +=
        q[j] * direction + (height * direction.dot(patch.g.col(j))) * patch.normal;
    sum.template segment<3>(9 + 3 * j) -= reaction[j] * direction;
  }
}

/// The same sum as w ∫ φ dA, φ = share p d − m with the patch's `depth` for d: where it fades, the
/// depth that counts is −d and ω is d/h.
inline PatchSum by_depth(const ContactPatch& patch, const PatchSum& sum) {
  return patch.fade > 0 ? PatchSum{-sum.p - sum.m / patch.fade} : sum;
}

/// φ at a point, of a sum by_depth().
inline double phi(const ContactPatch& patch, const PatchSum& sum, const Vec3& N) {
  return sum.share * sum.p.dot(N) * patch.depth.dot(N) - sum.m.dot(N);
}

/// ∮ φ N dl/|∇χ| along an edge.
inline Vec3 edge_sum(const ContactPatch& patch, const PatchEdge& edge, const PatchSum& sum) {
  const Vec3 &a = edge.a, &b = edge.b, middle = 0.5 * (a + b);
  return edge.length / 6 *
         (phi(patch, sum, a) * a + 4 * phi(patch, sum, middle) * middle + phi(patch, sum, b) * b);
}

}  // namespace articular::sim
