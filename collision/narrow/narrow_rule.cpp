#include "collision/narrow/narrow_rule.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "collision/narrow/gjk.hpp"
#include "collision/narrow/separating_axes.hpp"

namespace articular::collision {
namespace {

using TetrahedronCorners = Eigen::Matrix<double, 3, 4>;

/// Whether the boxes of the corners leave no gap of more than the margin along an axis. From
/// differences: far from the origin, boxes that are inflated first lose small margins to round-off.
bool boxes_within(const Eigen::Matrix3d& triangle, const TetrahedronCorners& tetrahedron,
                  double margin) {
  const Eigen::Vector3d low_t = triangle.rowwise().minCoeff(),
                        high_t = triangle.rowwise().maxCoeff(),
                        low_w = tetrahedron.rowwise().minCoeff(),
                        high_w = tetrahedron.rowwise().maxCoeff();
  return (low_t - high_w).cwiseMax(low_w - high_t).maxCoeff() <= margin;
}

/// Edges in a unit that makes the longest about 1, so that products of them stay in the range of
/// numbers. The unit is a power of two: nothing is lost by it.
template <class Edges>
Edges scaled(const Edges& edges) {
  const double longest = edges.cwiseAbs().maxCoeff();
  return longest > 0 ? Edges(edges * std::ldexp(1.0, -std::max(std::ilogb(longest), -1000)))
                     : edges;
}

}  // namespace

bool elements_meet(const Eigen::Matrix3d& triangle, const TetrahedronCorners& tetrahedron,
                   double margin, NarrowTest narrow) {
  if (!boxes_within(triangle, tetrahedron, margin)) return false;
  if (narrow == NarrowTest::Gjk) return gjk_overlap(triangle, tetrahedron, margin);
  return margin > 0 ? face_planes_overlap(triangle, tetrahedron, margin)
                    : separating_axes_overlap(triangle, tetrahedron);
}

bool face_planes_overlap(const Eigen::Matrix3d& triangle, const TetrahedronCorners& tetrahedron,
                         double margin) {
  // Only signs and lengths relative to the margin matter: normals may have any length.
  const Eigen::Matrix<double, 3, 2> sides =
      scaled<Eigen::Matrix<double, 3, 2>>(triangle.rightCols<2>().colwise() - triangle.col(0));
  const Eigen::Vector3d normal = sides.col(0).cross(sides.col(1));
  const Eigen::RowVector4d heights = normal.transpose() * (tetrahedron.colwise() - triangle.col(0));
  const double room = margin * normal.norm();
  if (heights.minCoeff() > room || heights.maxCoeff() < -room) return false;

  const Eigen::Matrix3d edges =
      scaled<Eigen::Matrix3d>(tetrahedron.rightCols<3>().colwise() - tetrahedron.col(0));
  const Eigen::Vector3d e1 = edges.col(0), e2 = edges.col(1), e3 = edges.col(2);
  const double six_volume = e1.dot(e2.cross(e3));
  // A flat tetrahedron has faces without an inside.
  if (six_volume == 0) return true;
  const double sign = six_volume > 0 ? 1 : -1;
  TetrahedronCorners gradients;  // of 6V times the barycentric coordinate i, scaled
  gradients << Eigen::Vector3d::Zero(), sign * e2.cross(e3), sign * e3.cross(e1),
      sign * e1.cross(e2);
  gradients.col(0) = -gradients.rowwise().sum();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d on_face = tetrahedron.col(i == 0 ? 1 : 0);
    const double highest =
        (gradients.col(i).transpose() * (triangle.colwise() - on_face)).maxCoeff();
    if (highest < -margin * gradients.col(i).norm()) return false;
  }
  return true;
}

}  // namespace articular::collision
