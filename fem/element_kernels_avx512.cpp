#define ARTICULAR_INSTRUCTION_SET avx512
#include "fem/element_kernels.inl.hpp"
