#include "collision/blocks/simd_avx512.hpp"
// The width of Vec comes first.
#define ARTICULAR_INSTRUCTION_SET avx512
#include "collision/blocks/block_kernels.inl.hpp"
