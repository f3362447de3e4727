#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <random>

#include "fem/base/types.hpp"

namespace articular::fem {

struct TetMesh {
  Positions X;
  Tetrahedra tets;
};

/// The box [0, size] [m] in cells[0] x cells[1] x cells[2] cells of six tetrahedra each, one for
/// every order in which a path along the cell's edges can take the axes (Kuhn's subdivision).
/// @param jitter  moves the inner nodes at random by up to this part of a cell; 0.15 keeps every
///                element positive
inline TetMesh box_mesh(const std::array<int, 3>& cells, const Vec3& size, double jitter = 0) {
  const std::array<int, 3> stride{1, cells[0] + 1, (cells[0] + 1) * (cells[1] + 1)};
  TetMesh mesh;
  mesh.X.resize(3, stride[2] * (cells[2] + 1));
  mesh.tets.resize(4, 6 * cells[0] * cells[1] * cells[2]);
  const Vec3 h(size.x() / cells[0], size.y() / cells[1], size.z() / cells[2]);
  std::minstd_rand random(7);
  std::uniform_real_distribution<double> uniform(-jitter, jitter);

  Eigen::Index element = 0;
  for (int k = 0; k <= cells[2]; ++k) {
    for (int j = 0; j <= cells[1]; ++j) {
      for (int i = 0; i <= cells[0]; ++i) {
        const int corner = i + stride[1] * j + stride[2] * k;
        const bool inner = i > 0 && i < cells[0] && j > 0 && j < cells[1] && k > 0 && k < cells[2];
        Vec3 grid(i, j, k);
        if (inner && jitter > 0) grid += Vec3(uniform(random), uniform(random), uniform(random));
        mesh.X.col(corner) = grid.cwiseProduct(h);
        if (i == cells[0] || j == cells[1] || k == cells[2]) continue;
        std::array<int, 3> axes{0, 1, 2};
        do {
          std::array<int, 4> path{corner};
          for (int step = 0; step < 3; ++step) path[step + 1] = path[step] + stride[axes[step]];
          const bool odd = (axes[1] - axes[0] + 3) % 3 == 2;  // an odd permutation turns it over
          if (odd) std::swap(path[1], path[2]);
          mesh.tets.col(element++) << path[0], path[1], path[2], path[3];
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
    }
  }
  return mesh;
}

}  // namespace articular::fem
