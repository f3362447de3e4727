#define ARTICULAR_INSTRUCTION_SET baseline
#include "fem/simd/element_kernels.inl.hpp"
