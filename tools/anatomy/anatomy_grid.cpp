#include "tools/anatomy/anatomy_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace articular::anatomy {
namespace {

/// Turned over if its volume is negative.
Eigen::Vector4i positive(Eigen::Vector4i tet, const Positions& X) {
  const Vec3 x0 = X.col(tet(0));
  const double volume = (X.col(tet(1)) - x0).cross(X.col(tet(2)) - x0).dot(X.col(tet(3)) - x0);
  if (volume < 0) std::swap(tet(2), tet(3));
  return tet;
}

}  // namespace

Mesh CellGrid::fill(const std::function<Vec3(double u, double v, double w)>& place) const {
  Mesh mesh;
  mesh.X_mm.resize(3, (nu + 1) * (nv + 1) * (nw + 1));
  for (int k = 0; k <= nw; ++k)
    for (int j = 0; j <= nv; ++j)
      for (int i = 0; i <= nu; ++i)
        mesh.X_mm.col(node(i, j, k)) =
            place(2.0 * i / nu - 1, 2.0 * j / nv - 1, static_cast<double>(k) / nw);

  // One tetrahedron for each order of the axes.
  static constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                        {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  mesh.tets.resize(4, 6 * nu * nv * nw);
  Eigen::Index e = 0;
  for (int k = 0; k < nw; ++k)
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        const int si = 2 * i >= nu ? 1 : -1, sj = 2 * j >= nv ? 1 : -1;
        const std::array<int, 3> step = {si, sj, 1};
        for (const auto& order : kOrders) {
          std::array<int, 3> c = {si > 0 ? i : i + 1, sj > 0 ? j : j + 1, k};
          Eigen::Vector4i tet;
          tet(0) = node(c[0], c[1], c[2]);
          for (int a = 0; a < 3; ++a) {
            const auto axis = static_cast<std::size_t>(order[a]);
            c[axis] += step[axis];
            tet(a + 1) = node(c[0], c[1], c[2]);
          }
          mesh.tets.col(e++) = positive(tet, mesh.X_mm);
        }
      }
  return mesh;
}

int even_cells(double length, double h, int least) {
  return 2 * std::max(least / 2, static_cast<int>(std::lround(length / h / 2)));
}

}  // namespace articular::anatomy
