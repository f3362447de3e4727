#include "fem/simd/point_kernels.hpp"
#include "fem/simd/stencil_kernels.hpp"
#include "fem/simd/viscosity_kernels.hpp"

namespace articular::fem {

const PointKernels& point_kernels(InstructionSet set, const SplitBatchLaw& law) {
  switch (set) {
    case InstructionSet::Avx512:
      return avx512::point_kernels(law);
    case InstructionSet::Avx2:
      return avx2::point_kernels(law);
    case InstructionSet::Baseline:
      break;
  }
  return baseline::point_kernels(law);
}

const StencilKernels& stencil_kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::Avx512:
      return avx512::stencil_kernels;
    case InstructionSet::Avx2:
      return avx2::stencil_kernels;
    case InstructionSet::Baseline:
      break;
  }
  return baseline::stencil_kernels;
}

const ViscosityKernels& viscosity_kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::Avx512:
      return avx512::viscosity_kernels;
    case InstructionSet::Avx2:
      return avx2::viscosity_kernels;
    case InstructionSet::Baseline:
      break;
  }
  return baseline::viscosity_kernels;
}

}  // namespace articular::fem
