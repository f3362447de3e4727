#pragma once

#include <functional>

#include "tools/anatomy/anatomy_mesh.hpp"

namespace articular::anatomy {

/// A block of cells, bent to any shape: each cell is cut into six tetrahedra along its diagonal
/// from the block's middle outwards. Cells of neighbouring quadrants are mirror images, so that
/// their faces agree and obtuse corners of an outline are halved.
struct CellGrid {
  int nu, nv, nw;  // cells; nu and nv even, so that there is a middle

  int node(int i, int j, int k) const { return i + (nu + 1) * (j + (nv + 1) * k); }
  /// @param place  of the node with u, v in [-1, 1] and w in [0, 1] [mm]
  Mesh fill(const std::function<Vec3(double u, double v, double w)>& place) const;
};

/// An even number of cells of about size h along a length, at least `least`.
int even_cells(double length, double h, int least);

}  // namespace articular::anatomy
