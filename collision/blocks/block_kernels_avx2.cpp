#include "collision/blocks/simd_avx2.hpp"
// The width of Vec comes first.
#define ARTICULAR_INSTRUCTION_SET avx2
#include "collision/blocks/block_kernels.inl.hpp"
