#pragma once

namespace articular::fem {

/// Where OpenBLAS reads which kernels to take, and the oldest of them.
inline constexpr const char *kBlasKernelsVariable = "OPENBLAS_CORETYPE",
                            *kOldestBlasKernels = "Prescott";

/// Makes of OpenBLAS what this module expects of it; before its first call of BLAS. Both settings
/// are those of the process, and nothing else in it uses BLAS.
///
/// One thread: sums are split by their number, and with one the answer has the same bits
/// everywhere.
///
/// Kernels of this processor: an OpenBLAS older than the processor does not know it and falls back
/// to those of Prescott, of 2004, which take several times as long. It then gets those of the
/// newest instructions that both know. What the environment says (OPENBLAS_CORETYPE) is left as it
/// is.
void set_up_blas();

}  // namespace articular::fem
