#include "collision/blocks/simd_baseline.hpp"
// The width of Vec comes first.
#define ARTICULAR_INSTRUCTION_SET baseline
#include "collision/blocks/block_kernels.inl.hpp"
