#define ARTICULAR_INSTRUCTION_SET avx2
#include "fem/simd/point_kernels.inl.hpp"
#include "fem/simd/stencil_kernels.inl.hpp"
#include "fem/simd/viscosity_kernels.inl.hpp"
