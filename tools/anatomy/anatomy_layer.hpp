#pragma once

#include <Eigen/Geometry>

#include "tools/anatomy/anatomy_grid.hpp"

/// Layers of cartilage on a grid: node layers from bone (first) to the articular surface (last).
/// mm.
namespace articular::anatomy {

/// Of all tetrahedra [mm^3].
double volume(const Mesh& mesh);

/// Of the grid's last layer of nodes [mm^2].
double top_area(const CellGrid& grid, const Mesh& mesh);

/// Grids so fine that the thickness does not depend on them.
inline constexpr CellGrid kFine{40, 80, 1};

/// Thickness in the middle of a layer whose mean, volume by articular area, is the one given.
/// @param layer  of a thickness, on the grid
template <class Layer>
double full_thickness(double mean, const Layer& layer) {
  constexpr int kRounds = 20;
  double full = mean, before = 0;
  for (int k = 0; k < kRounds && full != before; ++k) {  // to round-off
    before = full;
    const Mesh mesh = layer(kFine, full);
    full *= mean / (volume(mesh) / top_area(kFine, mesh));
  }
  return full;
}

}  // namespace articular::anatomy
