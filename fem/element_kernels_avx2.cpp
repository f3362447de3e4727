#define ARTICULAR_INSTRUCTION_SET avx2
#include "fem/element_kernels.inl.hpp"
