#include "fem/solver/processor.hpp"

#include "fem/simd/element_kernels.hpp"

// Declared here: cblas.h may be that of another BLAS, which has no such function.
extern "C" char* openblas_get_corename();

namespace articular::fem {
namespace {

const char* name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::Avx512:
      return "avx512f";
    case InstructionSet::Avx2:
      return "avx2";
    case InstructionSet::Baseline:
      break;
  }
  return "sse2";
}

}  // namespace

Processor processor() { return {name_of(best_instruction_set()), openblas_get_corename()}; }

}  // namespace articular::fem
