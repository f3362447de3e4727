#include "fem/sparse/blas.hpp"

#include <cstdlib>
#include <string_view>

// Declared here: cblas.h may be that of another BLAS, which has no such functions. The last two are
// not in an OpenBLAS that was built for one processor.
extern "C" {
void openblas_set_num_threads(int num_threads);
char* openblas_get_corename();
[[gnu::weak]] void gotoblas_dynamic_quit();
[[gnu::weak]] void gotoblas_dynamic_init();
}

namespace articular::fem {
namespace {

/// As OPENBLAS_CORETYPE says it; null: the processor has no more than the fallback needs.
const char* newest_kernels() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")) {
    return "SkylakeX";
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
  if (__builtin_cpu_supports("avx")) return "Sandybridge";
  return nullptr;
}

void replace_fallback() {
  if (std::getenv(kBlasKernelsVariable) != nullptr) return;
  if (openblas_get_corename() != std::string_view(kOldestBlasKernels)) return;
  const char* const kernels = newest_kernels();
  if (kernels == nullptr || gotoblas_dynamic_quit == nullptr || gotoblas_dynamic_init == nullptr) {
    return;
  }
  // OpenBLAS reads the variable where it chooses; programs that we start choose for themselves.
  setenv(kBlasKernelsVariable, kernels, 1);
  gotoblas_dynamic_quit();
  gotoblas_dynamic_init();
  unsetenv(kBlasKernelsVariable);
}

}  // namespace

void set_up_blas() {
  [[maybe_unused]] static const bool is_done = [] {
    replace_fallback();
    openblas_set_num_threads(1);
    return true;
  }();
}

}  // namespace articular::fem
