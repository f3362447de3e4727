#include "collision/simd_avx512.hpp"
// The width of Vec comes first.
#define ARTICULAR_INSTRUCTION_SET avx512
#include "collision/block_kernels.inl.hpp"
