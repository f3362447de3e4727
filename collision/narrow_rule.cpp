#include "collision/narrow_rule.hpp"

#include <Eigen/Geometry>

#include "collision/aabb.hpp"
#include "collision/gjk.hpp"
#include "collision/separating_axes.hpp"

namespace articular::collision {
namespace {

template <class Corners>
Aabb box_of(const Corners& corners, double margin) {
  Aabb box;
  box.min = corners.rowwise().minCoeff();
  box.max = corners.rowwise().maxCoeff();
  box.inflate(0.5 * margin);
  return box;
}

}  // namespace

bool elements_meet(const Eigen::Matrix3d& triangle, const Eigen::Matrix<double, 3, 4>& tetrahedron,
                   double margin, NarrowTest narrow) {
  if (!overlap(box_of(triangle, margin), box_of(tetrahedron, margin))) return false;
  if (narrow == NarrowTest::Gjk) return gjk_overlap(triangle, tetrahedron, margin);
  return margin > 0 ? face_planes_overlap(triangle, tetrahedron, margin)
                    : separating_axes_overlap(triangle, tetrahedron);
}

bool face_planes_overlap(const Eigen::Matrix3d& triangle,
                         const Eigen::Matrix<double, 3, 4>& tetrahedron, double margin) {
  const Eigen::Vector3d normal =
      (triangle.col(1) - triangle.col(0)).cross(triangle.col(2) - triangle.col(0));
  const Eigen::RowVector4d heights = normal.transpose() * (tetrahedron.colwise() - triangle.col(0));
  const double room = margin * normal.norm();
  if (heights.minCoeff() > room || heights.maxCoeff() < -room) return false;

  const Eigen::Vector3d a = tetrahedron.col(0), e1 = tetrahedron.col(1) - a,
                        e2 = tetrahedron.col(2) - a, e3 = tetrahedron.col(3) - a;
  const double six_volume = e1.dot(e2.cross(e3));
  // A flat tetrahedron has faces without an inside.
  if (six_volume == 0) return true;
  const double sign = six_volume > 0 ? 1 : -1;
  Eigen::Matrix<double, 3, 4> gradients;  // of L_i, 6V times the barycentric coordinate i
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
