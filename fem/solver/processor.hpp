#pragma once

#include <string>

#include "fem/sparse/blas.hpp"

namespace articular::fem {

/// What of this processor the last bits of results depend on: the instructions that our kernels use
/// ("avx2"), and the kernels that OpenBLAS has chosen for it ("Haswell"). Then the libraries that
/// compute with them.
struct Processor {
  std::string instruction_set, blas_kernels;
  std::string blas_version, cholmod_version;
};

Processor processor();

/// From here on our kernels are those that every x86-64 processor runs, and Eigen's blocks do not
/// go by the sizes of caches: what this module and its callers compute has the same bits on all.
/// OpenBLAS and the C library choose for themselves, when they are loaded: see kPortableBlas and
/// kPortableLibc.
void use_portable_kernels();

/// What the environment must say to these libraries before the program starts. The kernels of
/// Prescott need no more than SSE3. Of the C library's functions, exp and log among them, there are
/// versions with fused products and sums, which round otherwise.
inline constexpr const char *kPortableBlas = kOldestBlasKernels,
                            *kPortableBlasVariable = kBlasKernelsVariable,
                            *kPortableLibc = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4",
                            *kPortableLibcVariable = "GLIBC_TUNABLES";

}  // namespace articular::fem
