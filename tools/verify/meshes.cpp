#include "tools/verify/meshes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/mesh/shapes.hpp"
#include "tools/verify/random.hpp"

namespace articular::tools {
namespace {

/// The square [-1, 1]² to the unit disc, squares to circles, with equal angles along each side.
/// [Shirley 1997] Shirley, Chiu. A low distortion map between disk and square. J Graph Tools 2.
Eigen::Vector2d disc_point(double a, double b) {
  if (a == 0 && b == 0) return {0, 0};
  const double quarter = std::numbers::pi / 4;
  if (std::abs(a) > std::abs(b))
    return a * Eigen::Vector2d(std::cos(quarter * b / a), std::sin(quarter * b / a));
  return b * Eigen::Vector2d(std::sin(quarter * a / b), std::cos(quarter * a / b));
}

/// Radius of the corners of a regular polygon that has the polar moment of a circle: of n sides
/// it is R⁴ n/12 sin α (2 + cos α), α = 2π/n.
double corner_radius(double radius, int sides) {
  const double alpha = 2 * std::numbers::pi / sides;
  const double moment = sides / 12.0 * std::sin(alpha) * (2 + std::cos(alpha));
  return radius * std::pow(std::numbers::pi / 2 / moment, 0.25);
}

}  // namespace

sim::MeshData irregular_box(const Vec3& size, const Eigen::Vector3i& cells) {
  constexpr double kShift = 0.15;  // of a cell
  sim::MeshData mesh = sim::box_mesh({size, cells, size / 2});
  const Vec3 cell = size.cwiseQuotient(cells.cast<double>());
  Random random;
  for (auto X : mesh.X.colwise()) {
    Vec3 aside;
    for (double& shift : aside) shift = kShift * random();
    const Vec3 from_ends = X.cwiseMin(size - X);
    if ((from_ends.array() > 0.5 * cell.array()).all()) X += cell.cwiseProduct(aside);
  }
  return mesh;
}

sim::MeshData cylinder(double radius, double length, int cells_across, int cells_along) {
  const double corner = corner_radius(radius, 4 * cells_across);
  sim::MeshData mesh = sim::box_mesh(
      {Vec3(2, 2, length), {cells_across, cells_across, cells_along}, Vec3(0, 0, length / 2)});
  for (auto X : mesh.X.colwise()) X.head<2>() = corner * disc_point(X.x(), X.y());
  return mesh;
}

}  // namespace articular::tools
