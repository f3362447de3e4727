#define ARTICULAR_INSTRUCTION_SET avx2
#include "fem/simd/element_kernels.inl.hpp"
