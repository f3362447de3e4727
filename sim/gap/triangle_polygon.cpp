#include "sim/gap/triangle_polygon.hpp"

namespace articular::sim {

TrianglePolygon whole_triangle() {
  TrianglePolygon polygon;
  polygon.count = 3;
  for (int i = 0; i < 3; ++i) {
    polygon.corner[static_cast<std::size_t>(i)] = Vec3::Unit(i);
    polygon.side[static_cast<std::size_t>(i)] = -1 - (i + 2) % 3;
  }
  return polygon;
}

const TrianglePolygon& clipped(const Vec3& at_nodes, int side, const TrianglePolygon& polygon,
                               TrianglePolygon& room) {
  std::array<double, TrianglePolygon::kMaxCorners> level;
  bool all_inside = true;
  for (int i = 0; i < polygon.count; ++i) {
    level[static_cast<std::size_t>(i)] = at_nodes.dot(polygon.corner[static_cast<std::size_t>(i)]);
    all_inside = all_inside && level[static_cast<std::size_t>(i)] >= 0;
  }
  if (all_inside) return polygon;
  room.count = 0;
  const auto keep = [&](const Vec3& N, int edge) {
    room.corner[static_cast<std::size_t>(room.count)] = N;
    room.side[static_cast<std::size_t>(room.count++)] = edge;
  };
  for (int i = 0; i < polygon.count; ++i) {
    const auto a = static_cast<std::size_t>(i);
    const auto b = static_cast<std::size_t>(i + 1 == polygon.count ? 0 : i + 1);
    const double la = level[a], lb = level[b];
    if (la >= 0) keep(polygon.corner[a], polygon.side[a]);
    if ((la >= 0) != (lb >= 0))
      keep(polygon.corner[a] + la / (la - lb) * (polygon.corner[b] - polygon.corner[a]),
           la >= 0 ? side : polygon.side[a]);
  }
  return room;
}

/// A fan of triangles, each a/12 (Σ v vᵀ + (Σv)(Σv)ᵀ).
double integrate(const TrianglePolygon& polygon, Mat3& Q) {
  double total = 0;
  Q.setZero();
  const Vec3& v0 = polygon.corner[0];
  for (std::size_t i = 1; i + 1 < static_cast<std::size_t>(polygon.count); ++i) {
    const Vec3 &v1 = polygon.corner[i], &v2 = polygon.corner[i + 1];
    // Twice the area in (N1, N2), which is 1 for the whole triangle.
    const double area = (v1[1] - v0[1]) * (v2[2] - v0[2]) - (v1[2] - v0[2]) * (v2[1] - v0[1]);
    const Vec3 sum = v0 + v1 + v2;
    Q += area / 12 *
         (v0 * v0.transpose() + v1 * v1.transpose() + v2 * v2.transpose() + sum * sum.transpose());
    total += area;
  }
  return total;
}

/// A fan of triangles, by ∫ λ_i λ_j λ_k = a/60 times 1, 2 or 6 where none, two or all are the same.
Mat3 weighted_integral(const TrianglePolygon& polygon, const Vec3& weight_at_nodes) {
  Mat3 total = Mat3::Zero();
  Mat3 v;
  v.col(0) = polygon.corner[0];
  for (std::size_t i = 1; i + 1 < static_cast<std::size_t>(polygon.count); ++i) {
    v.col(1) = polygon.corner[i];
    v.col(2) = polygon.corner[i + 1];
    const double area =
        (v(1, 1) - v(1, 0)) * (v(2, 2) - v(2, 0)) - (v(2, 1) - v(2, 0)) * (v(1, 2) - v(1, 0));
    const Vec3 weight = v.transpose() * weight_at_nodes;
    const Vec3 sum = v.rowwise().sum(), moment = v * weight;
    const Vec3 both = weight.sum() * sum + moment;
    total += area / 60 *
             (both * sum.transpose() + sum * moment.transpose() +
              v * (2 * weight.array() + weight.sum()).matrix().asDiagonal() * v.transpose());
  }
  return total;
}

}  // namespace articular::sim
