#pragma once

#include <string>

namespace articular::sim {

/// What the last bits of results depend on, beside all inputs.
struct Provenance {
  std::string version;                        // of articular
  std::string compiler, flags;                // of the library
  std::string instruction_set, blas_kernels;  // on this machine, see fem::Processor
};

Provenance provenance();

}  // namespace articular::sim
