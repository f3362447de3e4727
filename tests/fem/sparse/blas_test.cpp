#include "fem/sparse/blas.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "fem/solver/processor.hpp"

namespace articular::fem::blas_test {

// What OpenBLAS takes where it does not know a processor has no more than SSE3.
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
  }
}

}  // namespace articular::fem::blas_test
