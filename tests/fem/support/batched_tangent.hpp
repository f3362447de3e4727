#pragma once

#include <array>

#include "fem/material/any_material.hpp"
#include "fem/simd/batched_law.hpp"
#include "tests/fem/support/laws.hpp"

namespace articular::fem {

/// ∂P/∂F of share Ψ_d(F) + p Θ(F) by the kernels, at a point with its fibre along kFibre.
inline Mat9 batched_tangent(InstructionSet set, const AnyMaterial& material, double share, double p,
                            const Mat3& F, double activation, Tangent tangent) {
  std::array<Eight, 9> F_of;
  std::array<Eight, 81> C_of;
  Eight pressure;
  EightIndices column;
  for (int lane = 0; lane < kBatchSize; ++lane) {
    column.lane[lane] = 0;
    pressure.lane[lane] = p;
    for (std::size_t k = 0; k < 9; ++k) F_of[k].lane[lane] = F.data()[k];
  }
  const FibreDirections directions = kFibre;
  const BatchedLaw law(set, material, activation);
  law.tangent({.F = F_of.data(), .share = share, .pressure = p == 0 ? nullptr : &pressure}, 1,
              {directions, column}, tangent, C_of.data());
  Mat9 C;
  for (std::size_t k = 0; k < 81; ++k) C.data()[k] = C_of[k].lane[0];
  return C;
}

}  // namespace articular::fem
