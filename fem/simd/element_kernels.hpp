#pragma once

#include "fem/material/batch_law.hpp"
#include "fem/simd/element_batch.hpp"

namespace articular::fem {

enum class InstructionSet { Baseline, Avx2, Avx512 };

/// The best one that this machine has, or after keep_to_baseline() the one that all have. Fused
/// products and sums round otherwise than two instructions.
InstructionSet best_instruction_set();
void keep_to_baseline();

/// The kernels of one law. Sums run in the order of the elements.
struct LawKernels {
  double (*energy)(const ChunkJob&);  // W [J]
  void (*force)(const ChunkJob&);
  void (*stiffness)(const ChunkJob&);
  void (*projected_stiffness)(const ChunkJob&);
  void (*force_and_stiffness)(const ChunkJob&);
  void (*force_and_projected_stiffness)(const ChunkJob&);
};

struct ElementKernels {
  LawKernels corotated, neo_hookean, coupled_neo_hookean;
};

/// @param set  one that the machine has
const LawKernels& element_kernels(InstructionSet set, BatchLaw::Kind law);

namespace baseline {
extern const ElementKernels kernels;
}
namespace avx2 {
extern const ElementKernels kernels;
}
namespace avx512 {
extern const ElementKernels kernels;
}

/// For the elements that the kernels leave alone: F = U diag(sigma) Vᵀ as rotation_svd has it.
/// Matrices column-major. Compiled for any machine, like all that uses Eigen.
void svd_of_hard_case(const double F[9], double U[9], double V[9], double sigma[3]);

}  // namespace articular::fem
