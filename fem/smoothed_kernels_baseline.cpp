#define ARTICULAR_INSTRUCTION_SET baseline
#include "fem/point_kernels.inl.hpp"
#include "fem/stencil_kernels.inl.hpp"
