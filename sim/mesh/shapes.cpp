#include "sim/mesh/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace articular::sim {
namespace {

/// Kuhn's six tetrahedra of a cell: the paths from corner 000 to corner 111, one axis at a time.
/// Mirrored from cell to cell (by parity) so that a mesh has no preferred diagonal.
constexpr std::array<std::array<int, 3>, 6> kAxisOrders = {
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

/// A grid of (cells + 1) nodes per axis, node (i, j, k) at map(i, j, k).
template <class Map>
MeshData grid_mesh(const Eigen::Vector3i& cells, Map&& map) {
  const Eigen::Vector3i nodes = cells.array() + 1;
  const auto index = [&](const Eigen::Vector3i& c) {
    return (c.z() * nodes.y() + c.y()) * nodes.x() + c.x();
  };
  MeshData mesh;
  mesh.X.resize(3, nodes.prod());
  for (int k = 0; k < nodes.z(); ++k)
    for (int j = 0; j < nodes.y(); ++j)
      for (int i = 0; i < nodes.x(); ++i) mesh.X.col(index({i, j, k})) = map(i, j, k);

  mesh.tets.resize(4, 6 * cells.prod());
  Eigen::Index t = 0;
  for (int k = 0; k < cells.z(); ++k)
    for (int j = 0; j < cells.y(); ++j)
      for (int i = 0; i < cells.x(); ++i) {
        const Eigen::Vector3i low(i, j, k);
        const Eigen::Vector3i flip(i % 2, j % 2, k % 2);
        for (const auto& order : kAxisOrders) {
          Eigen::Vector3i corner = flip;
          Eigen::Vector4i tet;
          tet[0] = index(low + corner);
          for (std::size_t step = 0; step < 3; ++step) {
            corner[order[step]] = 1 - corner[order[step]];
            tet[static_cast<Eigen::Index>(step) + 1] = index(low + corner);
          }
          const auto x = [&](int a) -> Vec3 { return mesh.X.col(tet[a]); };
          if ((x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0)) < 0) std::swap(tet[2], tet[3]);
          mesh.tets.col(t++) = tet;
        }
      }
  return mesh;
}

}  // namespace

MeshData box_mesh(const BoxGeometry& box) {
  const Vec3 cell = box.size.cwiseQuotient(box.cells.cast<double>());
  return grid_mesh(box.cells, [&](int i, int j, int k) -> Vec3 {
    return box.center - 0.5 * box.size + cell.cwiseProduct(Vec3(i, j, k));
  });
}

MeshData hexahedron_mesh(const HexahedronGeometry& hexahedron) {
  const auto& c = hexahedron.corners;
  return grid_mesh(hexahedron.cells, [&](int i, int j, int k) -> Vec3 {
    const Vec3 u = Vec3(i, j, k).cwiseQuotient(hexahedron.cells.cast<double>());
    const auto mix = [](double share, const Vec3& a, const Vec3& b) -> Vec3 {
      return (1 - share) * a + share * b;
    };
    const Vec3 low = mix(u.y(), mix(u.x(), c.col(0), c.col(1)), mix(u.x(), c.col(3), c.col(2)));
    const Vec3 high = mix(u.y(), mix(u.x(), c.col(4), c.col(5)), mix(u.x(), c.col(7), c.col(6)));
    return mix(u.z(), low, high);
  });
}

MeshData sphere_mesh(const SphereGeometry& sphere) {
  const int half = std::max(1, static_cast<int>(std::lround(sphere.radius / sphere.element_size)));
  return grid_mesh(Eigen::Vector3i::Constant(2 * half), [&](int i, int j, int k) -> Vec3 {
    // The cube [-1, 1]³ to the ball: each coordinate shrinks by what the two others have used.
    const Vec3 c = Vec3(i, j, k) / half - Vec3::Ones();
    const Vec3 q = c.cwiseProduct(c);
    const Vec3 ball(c.x() * std::sqrt(1 - q.y() / 2 - q.z() / 2 + q.y() * q.z() / 3),
                    c.y() * std::sqrt(1 - q.z() / 2 - q.x() / 2 + q.z() * q.x() / 3),
                    c.z() * std::sqrt(1 - q.x() / 2 - q.y() / 2 + q.x() * q.y() / 3));
    return sphere.center + sphere.radius * ball;
  });
}

MeshData v_shape_mesh(const VShapeGeometry& v) {
  const int along = v.cells.x(), across = v.cells.y();
  const double half_angle = 0.5 * v.angle;
  const Eigen::Vector2d leg(std::sin(half_angle), std::cos(half_angle));      // x, z
  const Eigen::Vector2d inward(-std::cos(half_angle), std::sin(half_angle));  // into the V
  return grid_mesh({2 * along, across, across}, [&](int i, int j, int k) -> Vec3 {
    const double side = i < along ? -1 : 1;
    const double fraction = std::abs(i - along) / static_cast<double>(along);
    const double y = v.width * (static_cast<double>(j) / across - 0.5);
    const double u = v.width * (static_cast<double>(k) / across - 0.5);
    // Both legs are mitred where they meet, in the plane x = 0: there s sin = u cos.
    const double miter = u * leg.y() / leg.x();
    const double s = miter + fraction * (v.leg_length - miter);
    const Eigen::Vector2d p = s * leg + u * inward;
    return {i == along ? 0.0 : side * p.x(), y, p.y()};
  });
}

void place(const Placement& placement, Positions& X) {
  Mat3 R = Mat3::Identity();
  if (const double angle = placement.rotation.norm(); angle > 0)
    R = Eigen::AngleAxisd(angle, placement.rotation / angle).toRotationMatrix();
  const Vec3 shift =
      placement.about + placement.translation - placement.scale * (R * placement.about);
  X = ((placement.scale * R) * X).colwise() + shift;
}

}  // namespace articular::sim
