#define ARTICULAR_INSTRUCTION_SET avx512
#include "fem/point_kernels.inl.hpp"
#include "fem/stencil_kernels.inl.hpp"
