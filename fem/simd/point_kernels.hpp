#pragma once

#include "fem/material/batch_law.hpp"
#include "fem/simd/element_batch.hpp"
#include "fem/simd/element_kernels.hpp"

namespace articular::fem {

/// Eight deformation gradients side by side, and what part each takes in a material's energy:
/// share Ψ_d(F) + p Θ(F).
struct EightPoints {
  const Eight* F;                // 9, column-major
  double share;                  // [-]; 0: the distortion is not looked at
  const Eight* pressure;         // [Pa]; null: the dilatation is not looked at
  const Eight* fibre = nullptr;  // 3, see FibreDirections; only laws with fibres look at it
};

/// The laws of tissue and their derivatives at eight points. All results are written, not added.
struct PointKernels {
  void (*energy_density)(const SplitBatchLaw&, const EightPoints&, Eight& W);  // [J/m³]
  void (*first_piola)(const SplitBatchLaw&, const EightPoints&, Eight* P);     // 9 [Pa]
  /// ∂P/∂F: entry (m, n) of the symmetric 9x9 matrix in C[m + 9 n] [Pa].
  void (*tangent)(const SplitBatchLaw&, const EightPoints&, Eight* C);
  /// Positive semidefinite, and no softer where the volume is kept: of isotropic laws the nearest
  /// to the sum of both parts, of fibres a sum of such (fibre_lanes.inl.hpp). Null where a law has
  /// no closed form of it.
  void (*projected_tangent)(const SplitBatchLaw&, const EightPoints&, Eight* C);
};

/// @param set  one that the machine has
const PointKernels& point_kernels(InstructionSet set, const SplitBatchLaw& law);

namespace baseline {
const PointKernels& point_kernels(const SplitBatchLaw& law);
}
namespace avx2 {
const PointKernels& point_kernels(const SplitBatchLaw& law);
}
namespace avx512 {
const PointKernels& point_kernels(const SplitBatchLaw& law);
}

}  // namespace articular::fem
