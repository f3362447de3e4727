#define ARTICULAR_INSTRUCTION_SET baseline
#include "fem/element_kernels.inl.hpp"
