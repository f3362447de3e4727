#include "tools/anatomy/anatomy_layer.hpp"

namespace articular::anatomy {

double volume(const Mesh& mesh) {
  double sum = 0;
  for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) {
    const Vec3 x0 = mesh.X_mm.col(mesh.tets(0, e));
    sum += (mesh.X_mm.col(mesh.tets(1, e)) - x0)
               .cross(mesh.X_mm.col(mesh.tets(2, e)) - x0)
               .dot(mesh.X_mm.col(mesh.tets(3, e)) - x0) /
           6;
  }
  return sum;
}

double top_area(const CellGrid& grid, const Mesh& mesh) {
  double sum = 0;
  for (int j = 0; j < grid.nv; ++j)
    for (int i = 0; i < grid.nu; ++i) {
      const auto corner = [&](int di, int dj) -> Vec3 {
        return mesh.X_mm.col(grid.node(i + di, j + dj, grid.nw));
      };
      sum += 0.5 * (corner(1, 1) - corner(0, 0)).cross(corner(0, 1) - corner(1, 0)).norm();
    }
  return sum;
}

}  // namespace articular::anatomy
