#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <vector>

#include "sim/contact/pressed_triangles.hpp"

/// Pressures that are given, on a square sheet.
namespace articular::sim {

using PressureField = std::function<double(double x, double y)>;

/// A square of the side 2 around the origin, in cells that are turned in its plane, where there is
/// pressure. @param at  where a point of the plane lies
inline std::vector<PressedTriangle> pressed_sheet(
    int cells, double turn, const PressureField& p,
    const std::function<Vec3(double x, double y)>& at = [](double x, double y) {
      return Vec3(x, y, 0);
    }) {
  std::vector<PressedTriangle> triangles;
  const auto add = [&](std::array<Eigen::Vector2d, 3> corners) {
    PressedTriangle triangle;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d q = Eigen::Rotation2Dd(turn) * corners[static_cast<std::size_t>(i)];
      triangle.x.col(i) = at(q.x(), q.y());
      triangle.p[i] = p(q.x(), q.y());
    }
    triangles.push_back(triangle);
  };
  const auto node = [&](int i, int j) {
    return Eigen::Vector2d(2.0 * i / cells - 1, 2.0 * j / cells - 1);
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      add({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      add({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return triangles;
}

}  // namespace articular::sim
