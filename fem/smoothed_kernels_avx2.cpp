#define ARTICULAR_INSTRUCTION_SET avx2
#include "fem/point_kernels.inl.hpp"
#include "fem/stencil_kernels.inl.hpp"
