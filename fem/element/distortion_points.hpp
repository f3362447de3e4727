#pragma once

#include <vector>

#include "fem/base/types.hpp"

namespace articular::fem {

class Elasticity;
class SmoothedElasticity;

/// Where a mesh of one material takes the energy of its distortion: W_d = Σ_k V_k Ψ_d(F_k), with
/// F_k = Σ_a x_a ⊗ ∂N_ka/∂X over the nodes a of point k. Plain tetrahedra have one point each;
/// smoothed ones have these too, with a smaller volume, and one more for each domain behind them.
struct DistortionPoints {
  std::vector<double> volume;   // V_k [m³]
  std::vector<int> node_begin;  // point k has the nodes node[node_begin[k] .. node_begin[k+1])
  std::vector<int> node;
  std::vector<Vec3> gradient;  // ∂N_ka/∂X [1/m], one for each entry of `node`
  FibreDirections fibres;      // one a point, or none

  int size() const { return static_cast<int>(volume.size()); }
};

DistortionPoints distortion_points(const Positions& X, const Elasticity& plain);
/// @param smoothed  of one material
DistortionPoints distortion_points(const Positions& X, const SmoothedElasticity& smoothed);

}  // namespace articular::fem
