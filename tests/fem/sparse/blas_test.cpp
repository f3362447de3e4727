#include "fem/sparse/blas.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "fem/solver/processor.hpp"

namespace articular::fem::blas_test {

// Where OpenBLAS does not know a processor it takes kernels of SSE3, or of AVX2.
TEST(Blas, HasKernelsOfTheProcessorAndLeavesTheEnvironmentAsItIs) {
  const char* const told = std::getenv(kPortableBlasVariable);
  const std::string before = told == nullptr ? "" : told;
  set_up_blas();
  const std::string kernels = processor().blas_kernels;
  if (told != nullptr) {
    EXPECT_EQ(kernels, before);
  } else {
    EXPECT_EQ(std::getenv(kPortableBlasVariable), nullptr);
    EXPECT_EQ(kernels == "Prescott", !__builtin_cpu_supports("avx")) << kernels;
    const bool has_avx512 = __builtin_cpu_supports("avx512dq") &&
                            __builtin_cpu_supports("avx512bw") &&
                            __builtin_cpu_supports("avx512vl");
    const std::set<std::string> of_avx512 = {"SkylakeX", "Cooperlake", "SapphireRapids"};
    EXPECT_EQ(of_avx512.contains(kernels), has_avx512) << kernels;
  }
}

}  // namespace articular::fem::blas_test
