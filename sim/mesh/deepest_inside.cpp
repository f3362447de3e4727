#include "sim/mesh/deepest_inside.hpp"

#include <Eigen/Geometry>
#include <utility>
#include <vector>

namespace articular::sim {
namespace {

Eigen::AlignedBox3d box_of(const Positions& X) {
  if (X.cols() == 0) return {};
  return {X.rowwise().minCoeff(), X.rowwise().maxCoeff()};
}

/// The sign of the volume of a tetrahedron.
int side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double volume = (b - a).cross(c - a).dot(d - a);
  return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

/// 1 where the way from p to q passes a triangle from behind, −1 from its front, 0 where it
/// doesn't.
int crossing(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int before = side(a, b, c, p), after = side(a, b, c, q);
  if (before == after) return 0;
  const int along = side(p, q, a, b);
  return along == side(p, q, b, c) && along == side(p, q, c, a) ? (after > before ? 1 : -1) : 0;
}

}  // namespace

Solid::Solid(Positions nodes, Triangles faces)
    : X(std::move(nodes)), triangles(std::move(faces)), tree(X, triangles), box(box_of(X)) {}

bool Solid::contains(const Vec3& x) const {
  if (!box.contains(x)) return false;
  const Vec3 beyond = x + 2 * box.diagonal().norm() * Vec3(0.3713, 0.2239, 0.9011);
  std::vector<int> near;
  tree.find(x, beyond, 0, near);
  int out = 0;
  for (const int t : near) {
    const auto corners = triangles.col(t);
    out += crossing(x, beyond, X.col(corners[0]), X.col(corners[1]), X.col(corners[2]));
  }
  return out != 0;
}

std::optional<DeepestPoint> deepest_inside(const Positions& points, const Solid& solid,
                                           double least) {
  std::optional<DeepestPoint> deepest;
  for (const Vec3 x : points.colwise()) {
    if (!solid.box.contains(x) || solid.tree.is_within(x, deepest ? deepest->depth : least) ||
        !solid.contains(x))
      continue;
    deepest = {x, solid.tree.distance(x)};
  }
  return deepest;
}

}  // namespace articular::sim
