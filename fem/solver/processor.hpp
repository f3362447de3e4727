#pragma once

#include <string>

namespace articular::fem {

/// What of this processor the last bits of results depend on: the instructions that our kernels use
/// ("avx2"), and the kernels that OpenBLAS has chosen for it ("Haswell").
struct Processor {
  std::string instruction_set, blas_kernels;
};

Processor processor();

}  // namespace articular::fem
