#include "sim/output/provenance.hpp"

#include "fem/solver/processor.hpp"
#include "sim/base/version.hpp"

namespace articular::sim {
namespace {

#ifdef __clang__
constexpr const char* kCompiler = __VERSION__;
#else
constexpr const char* kCompiler = "g++ " __VERSION__;
#endif

}  // namespace

Provenance provenance() {
  const fem::Processor processor = fem::processor();
  return {kVersion, kCompiler, ARTICULAR_FLAGS, processor.instruction_set, processor.blas_kernels};
}

}  // namespace articular::sim
