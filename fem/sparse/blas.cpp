#include "fem/sparse/blas.hpp"

#include <algorithm>
#include <array>
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

/// Kernels as OPENBLAS_CORETYPE says them, each with more instructions than those before it.
constexpr std::array<const char*, 4> kKernels = {kOldestBlasKernels, "Sandybridge", "Haswell",
                                                 "SkylakeX"};

/// The newest that the processor can run.
const char* newest_kernels() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")) {
    return kKernels[3];
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return kKernels[2];
  if (__builtin_cpu_supports("avx")) return kKernels[1];
  return kKernels[0];
}

/// Others than these are of one processor, which OpenBLAS knows well. Zen's are those of Haswell.
bool is_older(std::string_view kernels, std::string_view than) {
  const auto of = [](std::string_view name) { return std::ranges::find(kKernels, name); };
  const auto known = of(kernels == "Zen" ? "Haswell" : kernels);
  return known != kKernels.end() && known < of(than);
}

void replace_older() {
  if (std::getenv(kBlasKernelsVariable) != nullptr) return;
  const char* const kernels = newest_kernels();
  if (!is_older(openblas_get_corename(), kernels)) return;
  if (gotoblas_dynamic_quit == nullptr || gotoblas_dynamic_init == nullptr) return;
  // OpenBLAS reads the variable where it chooses; programs that we start choose for themselves.
  setenv(kBlasKernelsVariable, kernels, 1);
  gotoblas_dynamic_quit();
  gotoblas_dynamic_init();
  unsetenv(kBlasKernelsVariable);
}

}  // namespace

void set_up_blas() {
  [[maybe_unused]] static const bool is_done = [] {
    replace_older();
    openblas_set_num_threads(1);
    return true;
  }();
}

}  // namespace articular::fem
