#include "collision/narrow/face_planes.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace articular::collision {
namespace {

/// Farther from touching than this part of the pair's size, a verdict is safe: GJK counts shapes
/// nearer than 1e-7 as touching.
constexpr double kSafe = 1e-6;

/// Nodes of the face opposite node k.
constexpr std::array<std::array<int, 3>, 4> kFaces = {{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

}  // namespace

PlaneVerdict face_planes(const Eigen::Matrix3d& triangle,
                         const Eigen::Matrix<double, 3, 4>& tetrahedron, double margin) {
  const double size =
      (tetrahedron.rowwise().maxCoeff() - tetrahedron.rowwise().minCoeff()).maxCoeff() +
      (triangle.rowwise().maxCoeff() - triangle.rowwise().minCoeff()).maxCoeff();
  const double apart = margin + kSafe * (size + margin), inside_by = kSafe * size;

  const Eigen::Vector3d normal =
      (triangle.col(1) - triangle.col(0)).cross(triangle.col(2) - triangle.col(0));
  const Eigen::RowVector4d heights = normal.transpose() * (tetrahedron.colwise() - triangle.col(0));
  // Squares of tiny or enormous lengths leave the range of numbers: GJK scales, it decides then.
  const double normal_length = normal.norm();
  if (!(normal_length > 0) || !std::isfinite(normal_length)) return PlaneVerdict::Unknown;
  const double beyond = apart * normal_length;
  if (heights.minCoeff() > beyond || heights.maxCoeff() < -beyond) return PlaneVerdict::Apart;

  Eigen::Array3d depth = Eigen::Array3d::Constant(size);  // of the triangle's corners, least so far
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3d a = tetrahedron.col(kFaces[k][0]);
    Eigen::Vector3d outward =
        (tetrahedron.col(kFaces[k][1]) - a).cross(tetrahedron.col(kFaces[k][2]) - a);
    const double length = outward.norm();
    const double opposite = outward.dot(tetrahedron.col(static_cast<Eigen::Index>(k)) - a);
    // A flat tetrahedron has faces without an outside.
    if (!(length > 0) || !(std::abs(opposite) > kSafe * size * length))
      return PlaneVerdict::Unknown;
    outward *= (opposite > 0 ? -1 : 1) / length;
    const Eigen::Array3d above =
        (outward.transpose() * (triangle.colwise() - a)).transpose().array();
    if (above.minCoeff() > apart) return PlaneVerdict::Apart;
    depth = depth.min(-above);
  }
  return depth.maxCoeff() > inside_by ? PlaneVerdict::Overlapping : PlaneVerdict::Unknown;
}

}  // namespace articular::collision
