#define ARTICULAR_INSTRUCTION_SET avx512
#include "fem/simd/element_kernels.inl.hpp"
