#include "fem/solver/processor.hpp"

#include <cholmod.h>

#include <Eigen/Core>

#include "fem/simd/element_kernels.hpp"

// Declared here: cblas.h may be that of another BLAS, which has no such functions.
extern "C" char* openblas_get_corename();
extern "C" char* openblas_get_config();

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

std::string cholmod_version_text() {
  int version[3] = {0, 0, 0};
  cholmod_version(version);
  return std::to_string(version[0]) + "." + std::to_string(version[1]) + "." +
         std::to_string(version[2]);
}

}  // namespace

Processor processor() {
  set_up_blas();
  return {name_of(best_instruction_set()), openblas_get_corename(), openblas_get_config(),
          cholmod_version_text()};
}

void use_portable_kernels() {
  keep_to_baseline();
  constexpr std::ptrdiff_t kFirst = 32 << 10, kSecond = 256 << 10, kThird = 2 << 20;  // [bytes]
  Eigen::setCpuCacheSizes(kFirst, kSecond, kThird);
}

}  // namespace articular::fem
